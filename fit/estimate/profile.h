// Decides how sure one parameter is beyond the parabola of its standard deviation: it is held at values to both sides
// of the result, and all others are fitted again (profile likelihood). Does not find the result. Internal to fit/.
#pragma once

#include <functional>
#include <vector>

#include "fit/estimate/fit.h"
#include "fit/estimate/projection.h"

namespace hysteron {

/// What a profile starts from.
struct ProfileTask {
  DataModel* model = nullptr;
  const Judge* judge = nullptr;
  std::vector<FreeParameter> free;  ///< all, starting from the result
  std::vector<bool> affine;
  std::vector<int> recordings;
  Trial fixed;
  double chi2 = 0, s2 = 1;  ///< at the result, priors included
  int max_iterations = 40;
  std::function<bool()> go_on;
};

/// Profile of free parameter `which`, whose standard deviation is about `sigma` [SI] (0 = unknown). Both sides are
/// walked until chi2 has risen by 3.84 s2, a bound is met or nothing can be simulated; values that were tried are all
/// in the result. A fit better than the result, where one is met, comes back in `better` (values of all free
/// parameters).
Profile profile_of(const ProfileTask& task, int which, double sigma, std::vector<double>& better);

/// How a local search ended.
struct SearchEnd {
  int iterations = 0;
  bool converged = false;
  bool flat = false;  ///< nothing moved a row where it began
  std::string message;
};

/// One bounded local search from z; the best point, or null where nothing could be simulated.
PointPointer search_locally(Projection& projection, std::vector<double> z, int max_iterations, double tolerance,
                            const std::function<bool()>& go_on, SearchEnd& end, double matters = 0);

}  // namespace hysteron
