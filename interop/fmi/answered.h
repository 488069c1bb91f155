// Decides what becomes of exceptions at the border of an FMU: a status, and our text for the logger of the caller.
#pragma once

#include <exception>
#include <string>

#include "engine/diagram/error.h"
#include "engine/diagram/stop.h"

namespace hysteron::interop {

/// What the exception that is being handled says.
inline std::string text_of_exception() {
  try {
    throw;
  } catch (const Error& e) {
    return to_text(e.problems);
  } catch (const std::exception& e) {
    return e.what();
  } catch (...) {
    return "it was stopped";
  }
}

/// `well` where the action ends, else `failed`, and `tell` gets the text.
template <class Status, class Tell, class Action>
Status answered(Status well, Status failed, const Tell& tell, const Action& action) noexcept {
  try {
    try {
      action();
      return well;
    } catch (...) {
      tell(text_of_exception());
    }
  } catch (...) {  // no memory for the text
  }
  return failed;
}

}  // namespace hysteron::interop
