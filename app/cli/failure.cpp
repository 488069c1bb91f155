// Decides how a failure looks: as text for people, or as JSON for programs (--errors json).
// Does not decide what a failure is (engine/diagram/error.h).
#include "app/cli/failure.h"

#include <cstdio>
#include <new>
#include <system_error>

#include "app/cli/answer_json.h"
#include "app/cli/interrupt.h"
#include "app/cli/shape.h"
#include "app/cli/verb.h"
#include "engine/diagram/stop.h"
#include "io/json/problems_json.h"

namespace hysteron {
namespace {

/// One problem that no room reported as an Error: an exception of the library.
Failure unexpected(const char* what) {
  return {
      exit_code::numerics,
      {{"unexpected", "hysteron", what,
        "this should have been reported with a cure; please report it with the command line and the files", "", 0}}};
}

}  // namespace

Failure failure_of(const std::exception_ptr& exception) {
  try {
    std::rethrow_exception(exception);
  } catch (const Error& error) {
    return {error.fault == Fault::input ? exit_code::bad_input : exit_code::numerics, error.problems};
  } catch (const Interrupted& stop) {
    return {exit_code::interrupted, {}, stop.what()};
  } catch (const Stopped&) {
    return {exit_code::interrupted, {}, "interrupted; nothing is written"};
  } catch (const std::bad_alloc&) {
    return {exit_code::numerics,
            {{"out_of_memory", "hysteron", "this machine ran out of memory",
              "record fewer signals, or use a larger \"every\"", "", 0}}};
  } catch (const std::system_error& error) {
    return {exit_code::bad_input,
            {{"cannot_write", "files", error.what(), "check the disk and the rights of the folder", "", 0}},
            "",
            true};
  } catch (const std::exception& error) {
    return unexpected(error.what());
  } catch (...) {
    return unexpected("an exception without a name");
  }
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
