// Decides what stands behind the handles of hysteron.h, and how exceptions become errors at its border.
#pragma once

#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "app/cli/perform.h"
#include "engine/program/program.h"
#include "engine/simulate/stepped_simulation.h"
#include "interop/c/asked.h"
#include "interop/c/hysteron.h"

namespace hysteron::interop {

/// Whatever hy_free() gets: every handle begins with it.
struct Handle {
  virtual ~Handle() = default;
};

hy_error* error_of(const std::exception_ptr& exception);

/// What `action` returns, or `failed` and an error.
template <class Result, class Action>
Result guarded(hy_error** error, Result failed, const Action& action) noexcept {
  if (error != nullptr) *error = nullptr;
  try {
    return action();
  } catch (...) {
    if (error != nullptr) *error = error_of(std::current_exception());
    return failed;
  }
}

/// The same for functions that return an exit code.
template <class Action>
int guarded_code(hy_error** error, const Action& action) noexcept {
  hy_error* own = nullptr;
  const int done = guarded<int>(&own, HY_NUMERICS, [&] {
    action();
    return static_cast<int>(HY_DONE);
  });
  const int code = own != nullptr ? hy_error_code(own) : done;
  if (error != nullptr)
    *error = own;
  else
    hy_free(own);
  return code;
}

/// Throws Error "bad_call" where a function was called with NULL for `what`.
void need(const void* pointer, const char* what);

}  // namespace hysteron::interop

// The handles have the names of the interface, which is C.
struct hy_error : hysteron::interop::Handle {
  int code = HY_DONE;
  std::string json;
};

struct hy_diagram : hysteron::interop::Handle {
  hysteron::Diagram diagram;
  hysteron::ProgramPointer program;
  std::string json;
};

struct hy_result : hysteron::interop::Handle {
  hysteron::Answer answer;
  std::string json;
  std::vector<std::unique_ptr<std::string>> figures;  ///< as they were asked for
};

struct hy_stepper : hysteron::interop::Handle {
  hy_stepper(const hysteron::ProgramPointer& program, const hysteron::SimulateOptions& options)
      : stepper(program, options) {}
  explicit hy_stepper(const hysteron::SteppedSimulation& other) : stepper(other) {}
  hysteron::SteppedSimulation stepper;
  std::unique_ptr<hysteron::interop::Asked> asked;  ///< by hy_stepper_watch(); of this one alone, not of copies
};
