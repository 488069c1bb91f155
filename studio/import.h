// Decides what becomes of a recording that is dropped on the page: it is kept aside, looked at, and then either a
// diagram and a data set are made for it, or it joins a data set. Does not read recordings: the verb new does.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "studio/folder.h"
#include "studio/job_words.h"
#include "studio/own_verbs.h"

namespace hysteron::studio {

class Import {
 public:
  Import(const OpenFolder& folder, JobVerb verb_new, OwnVerbs own)
      : folder_(folder), new_(std::move(verb_new)), own_(std::move(own)) {}

  /// Keeps the bytes aside, in .hysteron/dropped, and returns the name in the folder. Throws Error "bad_name".
  std::string keep(const std::string& name, const std::string& bytes) const;

  /// Of {"file", "options"}, these as the verb new has them: {"file", "raw": [{"name", "unit", "values"}], "columns":
  /// [{"name", "unit", "smallest", "largest", "low", "high"}], "rows", "from", "to", "time_unit", "as_it_stands",
  /// "assumed", "inputs", "outputs", "questions"}. "columns" is empty as long as a question is open.
  nlohmann::ordered_json preview(const nlohmann::json& asked) const;

  /// A folder with a starter diagram for {"files", "options", "folder"}: what "hysteron new" answers, with the words of
  /// that command line and the names of "diagram" and "dataset" in the folder. Throws as the verb.
  nlohmann::ordered_json start(const nlohmann::json& asked) const;

  /// Puts {"file", "options", "role"} beside the data set "dataset" and into it. {"recording": its name in the folder}.
  /// Throws Error "file_exists" where another file of that name lies there, and as the verb new.
  nlohmann::ordered_json join(const nlohmann::json& asked) const;

 private:
  nlohmann::ordered_json carried_out(const std::vector<std::string>& files, const nlohmann::json& options,
                                     const std::string& target) const;

  const OpenFolder& folder_;
  JobVerb new_;
  OwnVerbs own_;
};

}  // namespace hysteron::studio
