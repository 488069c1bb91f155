// Decides whether a model still explains a recording as it stands: a yes or no, and the name of what is new. Does not
// fit the model to the recording first: what has moved is the answer, not a matter of course.
#pragma once

#include <string>
#include <vector>

#include "discover/search/discovery.h"

namespace hysteron {

/// Roles tell where a further effect would be fitted and where judged. Recordings that all have one role are new ones,
/// not somebody's split: each is cut in time.
DataSet with_both_roles(DataSet data);

struct Check {
  bool explained = false;
  /// Not explained as the model stands, but with other values of what is free in it, and nothing else.
  bool moved = false;
  std::vector<std::string> named;  ///< effect ids, first finding first; "parameters" where `moved`
  std::string sentence;            ///< the answer, for people
  Discovery discovery;             ///< that the answer rests on
};

/// The model with every parameter held (zeros of a sensor that are another one in each recording are not the model's)
/// is judged as `discover` judges whether a model is adequate. Where it is not, what is free in it is fitted; what that
/// does not explain is named by a discovery.
Check check(const Diagram& diagram, const DataSet& data, const Registry& registry, const Effects& effects,
            const DiscoverOptions& options = {});

}  // namespace hysteron
