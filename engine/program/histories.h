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
  /// `states`: those at a time inside the step [s]. Throws Error(Fault::numerics) "past_too_fast" where a signal moves
  /// to and fro in the step more often than can be remembered.
  void fill(Run& run, Work& work, double from, double to,
            const std::function<void(double t, std::vector<double>& x)>& states);

 private:
  struct Point {
    double t = 0;
    std::vector<double> u, rate;  // per history
  };
  /// Between two points, and what was looked at between them.
  struct Piece {
    const Point& a;
    Point p, q;
    const Point& b;
  };
  struct Watched {
    int block, history, signal;
    double size;
  };
  void look(const Run& run, Work& work, double t, Point& into);
  bool is_off(std::size_t i, const Piece& piece, const Point& seen, double curve) const;
  /// The histories whose curve through the ends of the piece, with the rates there, is not what it was between them.
  std::vector<std::size_t> missed(const Piece& piece) const;
  /// The states inside of a step are a curve of the integrator's, whose slope is not what the diagram says of its
  /// values: the stiffer the diagram the less so, and of a first order least of all. Points do not help against that, a
  /// rate that belongs to the values does. False if it is the values that do not lie on a cubic.
  bool follow_values(Run& run, Work& work, const Piece& piece, const std::vector<std::size_t>& signals);
  void refine(Run& run, Work& work, const Point& a, const Point& b, int depth);
  void keep(Run& run, const Point& p);
  [[noreturn]] void refuse(const Watched& w, double t) const;

  const Program& program_;
  double tolerance_;
  std::vector<Watched> watched_;
  const std::function<void(double t, std::vector<double>& x)>* states_ = nullptr;
  double from_ = 0, to_ = 0;  // the step [s]
  long points_ = 0;           // in it
  std::vector<double> x_;
};

}  // namespace hysteron
