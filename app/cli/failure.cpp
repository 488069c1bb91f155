// Decides how a failure looks: as text for people, or as JSON for programs (--errors json).
// Does not decide what a failure is (engine/diagram/error.h).
#include "app/cli/failure.h"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace hysteron {

std::string problems_json(const std::vector<Problem>& problems, int code) {
  nlohmann::ordered_json root;
  root["exit_code"] = code;
  root["problems"] = nlohmann::ordered_json::array();
  for (const auto& p : problems) {
    nlohmann::ordered_json entry;
    entry["code"] = p.code;
    entry["path"] = p.path;
    entry["what"] = p.what;
    entry["cure"] = p.cure;
    if (!p.file.empty()) entry["file"] = p.file;
    if (p.line > 0) entry["line"] = p.line;
    root["problems"].push_back(std::move(entry));
  }
  // A file name or a cell of a CSV may hold bytes that are no UTF-8.
  return root.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void print_problems(const std::vector<Problem>& problems, int code, bool as_json) {
  const std::string text = as_json ? problems_json(problems, code) : to_text(problems) + "\n";
  std::fwrite(text.data(), 1, text.size(), stderr);
}

}  // namespace hysteron
