// Decides what concerns all handles: errors, freeing, the version.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/cli/failure.h"
#include "interop/c/handles.h"
#include "io/json/problems_json.h"

namespace hysteron::interop {
namespace {

std::string failure_json(const Failure& failure) {
  nlohmann::ordered_json json{{"exit_code", failure.code}, {"problems", problem_list(failure.problems)}};
  if (failure.code == exit_code::interrupted) json["interrupted"] = failure.interrupted;
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace

hy_error* error_of(const std::exception_ptr& exception) {
  auto error = std::make_unique<hy_error>();
  const Failure failure = failure_of(exception);
  error->code = failure.code;
  error->json = failure_json(failure);
  return error.release();
}

void need(const void* pointer, const char* what) {
  if (pointer == nullptr)
    fail("bad_call", what, fmt::format("NULL was given for {}", what), "give what hysteron.h asks for");
}

}  // namespace hysteron::interop

using namespace hysteron;

const char* hy_version(void) { return HYSTERON_VERSION; }

void hy_free(void* handle) { delete static_cast<interop::Handle*>(handle); }

const char* hy_error_json(const hy_error* error) { return error == nullptr ? "{}" : error->json.c_str(); }
int hy_error_code(const hy_error* error) { return error == nullptr ? HY_DONE : error->code; }
