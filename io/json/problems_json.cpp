#include "io/json/problems_json.h"

#include <nlohmann/json.hpp>

namespace hysteron {

nlohmann::ordered_json problem_list(const std::vector<Problem>& problems) {
  auto list = nlohmann::ordered_json::array();
  for (const auto& p : problems) {
    nlohmann::ordered_json entry;
    entry["code"] = p.code;
    entry["path"] = p.path;
    entry["what"] = p.what;
    entry["cure"] = p.cure;
    if (!p.file.empty()) entry["file"] = p.file;
    if (p.line > 0) entry["line"] = p.line;
    list.push_back(std::move(entry));
  }
  return list;
}

std::string problems_json(const std::vector<Problem>& problems, int code) {
  nlohmann::ordered_json root;
  root["exit_code"] = code;
  root["problems"] = problem_list(problems);
  // A file name or a cell of a CSV may hold bytes that are no UTF-8.
  return root.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace hysteron
