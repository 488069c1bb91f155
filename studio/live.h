// Decides how a diagram answers while a number is dragged: the verb is carried out in this process, with the number in
// place of what the file says, and nothing is kept. Slow diagrams are told so and run when the number is let go.
#pragma once

#include <atomic>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "studio/folder.h"
#include "studio/job_words.h"
#include "studio/own_verbs.h"

namespace hysteron::studio {

class Live {
 public:
  Live(const OpenFolder& folder, std::vector<JobVerb> verbs, std::vector<std::string> allowed, OwnVerbs own)
      : folder_(folder), verbs_(std::move(verbs)), allowed_(std::move(allowed)), own_(std::move(own)) {}

  /// The traces of {"verb", "diagram", "other", "options", "trace", "columns", "from", "to", "pixels", "patience"}:
  /// float64, little-endian: the length of a JSON text, filled up with blanks to whole numbers; that text, {"headline",
  /// "facts", "trace", "traces", "columns": [{"name", "unit"}], "rows"}; then as TraceFiles::stretch() of the columns
  /// that are there. A request that comes in while another is computed ends that one. Throws as job_words() and the
  /// verb; Error "took_too_long" after "patience" [ms].
  std::string answer(const nlohmann::json& asked);

 private:
  const OpenFolder& folder_;
  std::vector<JobVerb> verbs_;
  std::vector<std::string> allowed_;
  OwnVerbs own_;
  std::atomic<long> newest_{0};
  std::mutex one_;
};

}  // namespace hysteron::studio
