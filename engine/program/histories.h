// Decides what is kept of the past of a signal, for dead times: its accepted points, and between them as many more as
// it takes for the curve through them to be the signal. Does not read it back: blocks/continuous/history.h.
#pragma once

#include <functional>
#include <vector>

#include "engine/program/program.h"

namespace hysteron {

/// Appends the present point (t, and the values and rates in `work`) to every history and forgets what no dead time can
/// reach any more.
void remember_signals(const Program& program, Run& run, const Work& work, double t);

/// Before the first point: what each dead time reads was at rest at its value at the start (t, x), dead times behind
/// dead times included.
/// Returns true if that moved the output of one.
bool rest_histories(const Program& program, Run& run, Work& work, double t, const double* x);

/// Fills the histories inside of a step that has been done and whose end is not accepted yet.
class Histories {
 public:
  /// `sizes`: usual size of each signal [SI]; the curve is right to `tolerance` times that.
  Histories(const Program& program, std::vector<double> sizes, double tolerance);

  bool any() const { return !watched_.empty(); }
  /// `states`: those at a time inside the step [s].
  void fill(Run& run, Work& work, double from, double to,
            const std::function<void(double t, std::vector<double>& x)>& states);

 private:
  struct Point {
    double t = 0;
    std::vector<double> u, rate;  // per history
  };
  void look(const Run& run, Work& work, double t, Point& into);
  bool between(const Point& a, const Point& p, const Point& b) const;
  void refine(Run& run, Work& work, const Point& a, const Point& b, int depth);
  void keep(Run& run, const Point& p) const;

  const Program& program_;
  double tolerance_;
  struct Watched {
    int history, signal;
    double size;
  };
  std::vector<Watched> watched_;
  const std::function<void(double t, std::vector<double>& x)>* states_ = nullptr;
  std::vector<double> x_;
};

}  // namespace hysteron
