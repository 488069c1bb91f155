// Decides what a verb gives back: what people read, what programs read, and what is to be put in place. A verb itself
// prints nothing and publishes nothing (perform.h does). Does not decide how an answer looks.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/cli/verb.h"
#include "engine/diagram/error.h"
#include "io/results/result.h"
#include "report/pages/facts.h"

namespace hysteron {

struct HeldFolder;  // publish.h

/// A file that belongs to an answer.
struct WrittenFile {
  std::string path;
  std::string content{};
  bool in_place = false;  ///< it was written before, by the work itself
};

/// In the order in which it is told and put in place: text, folder, files, closing.
struct Answer {
  int exit_code = exit_code::done;
  std::string text{};                  ///< read before anything is put in place
  std::string folder{};                ///< where `document` goes; "": nowhere
  Document document{};                 ///< what people read of it are headline, sentences, warnings and verdict
  std::vector<std::string> asides{};   ///< read behind the warnings, kept nowhere: times, which no result depends on
  std::shared_ptr<HeldFolder> held{};  ///< of `folder`, where parts of the results were written before
  std::vector<WrittenFile> files{};    ///< beside those of `document`
  std::string closing{};               ///< read when all is in place
  std::string interrupted{};           ///< what is kept of work that was ended early: on the error stream, at last
  /// Members of what --json says, as Verb::shape declares them; none: "facts", those of the document.
  Facts facts{};
  std::vector<std::string> warnings{};  ///< of --json, beside those of the document
};

/// An error of work that had something to say before.
class ErrorBehindText : public Error {
 public:
  ErrorBehindText(const Error& error, std::string text) : Error(error.fault, error.problems), text_(std::move(text)) {}
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// Runs `action`; an Error that it throws comes behind `text`, as it is then.
template <class Action>
void behind(const std::string& text, const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    throw ErrorBehindText(error, text);
  }
}

}  // namespace hysteron
