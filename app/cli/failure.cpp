// Decides how a failure looks: as text for people, or as JSON for programs (--errors json).
// Does not decide what a failure is (engine/diagram/error.h).
#include "app/cli/failure.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/cli/answer_json.h"
#include "app/cli/shape.h"

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

std::string failure_schema() {
  using namespace shape;
  const Facts problem = object("one of them", {{"code", text("its kind, for programs")},
                                               {"path", text("where: an option, a file, a place in a file")},
                                               {"what", text("is wrong")},
                                               {"cure", text("what to do")},
                                               {"file", text("in which it lies"), sometimes},
                                               {"line", whole("of the file, from 1"), sometimes}});
  return schema_text("failure of hysteron", object("What is printed on the error stream with --json or --errors json.",
                                                   {{"exit_code", whole("2: wrong input, 3: the numerics failed")},
                                                    {"problems", list("all that were found", problem)}}));
}

void print_problems(const std::vector<Problem>& problems, int code, bool as_json) {
  const std::string text = as_json ? problems_json(problems, code) : to_text(problems) + "\n";
  std::fwrite(text.data(), 1, text.size(), stderr);
}

}  // namespace hysteron
