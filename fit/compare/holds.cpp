#include "fit/compare/holds.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "fit/signals/row_checks.h"
#include "fit/signals/whiten.h"

namespace hysteron {

Holds holds_of(const std::vector<SplitInput>& recordings, const std::vector<std::vector<Branch>>& branch) {
  Holds h;
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    const Rows &t = *recordings[r].t, &u = *recordings[r].u;
    Rows rows(t.size(), -1.0);
    const auto [low, high] = std::minmax_element(u.begin(), u.end());
    const double step =
        std::max(0.005 * (*high - *low), 6 * (recordings[r].rough >= 0 ? recordings[r].rough : roughness(u)));
    double since = 0;
    for (std::size_t i = 0; i < t.size(); ++i) {
      if (branch[r][i] != Branch::hold) continue;
      // A step from one hold to the next takes one row and shows no moving row between.
      const bool steps = i > 0 && branch[r][i - 1] == Branch::hold && std::abs(u[i] - u[i - 1]) > step;
      if (steps || i == 0 || branch[r][i - 1] != Branch::hold) {
        since = t[i];
        if (i > 0) ++(steps ? h.after_step : h.after_motion);
      }
      rows[i] = t[i] - since;
      if (rows[i] > 0) h.shortest = std::min(h.shortest, rows[i]);
      h.longest = std::max(h.longest, rows[i]);
    }
    h.age.push_back(std::move(rows));
  }
  return h;
}
namespace {

/// How well the residual within holds goes along with a function of their age. Steps up and down drift either way: each
/// hold has a mean and a slope of its own, and what these explain adds up.
struct Along {
  double ee = 0, explained = 0;
  void add(const Rows& x, const Rows& e) {
    const auto n = static_cast<double>(x.size());
    const double mx = std::accumulate(x.begin(), x.end(), 0.0) / n, me = std::accumulate(e.begin(), e.end(), 0.0) / n;
    double xx_own = 0, xe_own = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      xx_own += (x[i] - mx) * (x[i] - mx);
      xe_own += (x[i] - mx) * (e[i] - me);
      ee += (e[i] - me) * (e[i] - me);
    }
    if (xx_own > 0) explained += xe_own * xe_own / xx_own;
  }
  double share() const { return ee > 0 ? explained / ee : 0; }
};
}  // namespace

std::string growth_of(const Holds& holds, const std::vector<SplitInput>& recordings) {
  Along by_log, by_time;
  double early = 0, late = 0;  // mean squares of the first and the last third of the decades, summed over holds
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    const Rows &age = holds.age[r], &e = *recordings[r].residual;
    for (std::size_t i = 0; i < age.size();) {
      if (age[i] != 0) {
        ++i;
        continue;
      }
      Rows seconds, decades, error;
      for (++i; i < age.size() && age[i] > 0; ++i) {
        seconds.push_back(age[i]);
        decades.push_back(std::log10(age[i]));
        error.push_back(e[i]);
      }
      if (seconds.size() < 20 || seconds.back() < 100 * seconds.front()) continue;
      by_log.add(decades, error);
      by_time.add(seconds, error);
      const double third = (decades.back() - decades.front()) / 3;
      double before = 0, behind = 0, n_before = 0, n_behind = 0;
      for (std::size_t k = 0; k < error.size(); ++k) {
        const bool first = decades[k]<decades.front() + third, last = decades[k]> decades.back() - third;
        before += first ? error[k] * error[k] : 0;
        behind += last ? error[k] * error[k] : 0;
        n_before += first ? 1 : 0;
        n_behind += last ? 1 : 0;
      }
      early += before / std::max(n_before, 1.0);
      late += behind / std::max(n_behind, 1.0);
    }
  }
  // More than half of what moves within the holds follows it, and it is the better of the two.
  const double best = std::max(by_log.share(), by_time.share());
  if (best < 0.5 || late <= early) return "";
  return by_log.share() > by_time.share() ? ", growing with log time" : ", growing with time";
}

}  // namespace hysteron
