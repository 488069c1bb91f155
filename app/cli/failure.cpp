// Decides how a failure looks: as text for people, or as JSON for programs (--errors json).
// Does not decide what a failure is (engine/diagram/error.h).
#include "app/cli/failure.h"

#include <cstdio>

#include "app/cli/answer_json.h"
#include "app/cli/shape.h"
#include "io/json/problems_json.h"

namespace hysteron {

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
