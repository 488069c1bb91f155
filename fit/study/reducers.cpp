#include "fit/study/reducers.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/block/simd_dispatch.h"

namespace hysteron {
namespace {

/// Numbers of a piece, each with one place per lane.
enum Number {
  y,
  y_before,
  zero,
  start,
  finite,
  low,
  high,
  sum,
  square,
  middle,
  scatter,
  x_start,
  x_before,
  twice,
  y_a,
  y_b,
  numbers
};

/// One row for lanes side by side.
struct RowOf {
  TracePiece& piece;
  long k;
  const double* signals;
  int lanes;

  const double* signal(int s) const { return signals + static_cast<std::ptrdiff_t>(s) * lanes; }
  double* at(Number number) const { return piece.numbers.data() + static_cast<std::ptrdiff_t>(number) * lanes; }
  bool begins() const { return k == piece.of.first; }
  template <class Action>
  void each(const Action& action) const {
#pragma GCC ivdep
    for (int l = 0; l < lanes; ++l) action(l);
  }

  /// The value of the trace in this row.
  void take() const {
    const TraceFeature& of = piece.of;
    double *const now = at(y), *const z = at(zero);
    const double* const value = signal(of.signal);
    each([&](int l) { now[l] = value[l]; });
    if (of.minus >= 0) {
      const double* const less = signal(of.minus);
      each([&](int l) { now[l] -= less[l]; });
    }
    if (!of.less.empty()) {
      const double less = of.less[static_cast<std::size_t>(k)];
      each([&](int l) { now[l] -= less; });
    }
    if (!of.rezero) return;
    if (begins()) each([&](int l) { z[l] = now[l]; });
    each([&](int l) { now[l] -= z[l]; });
  }

  void begin() const {
    const double* const now = at(y);
    for (const Number number : {start, low, high}) {
      double* const v = at(number);
      each([&](int l) { v[l] = now[l]; });
    }
    for (const Number number : {finite, sum, square, middle, scatter, twice}) {
      double* const v = at(number);
      each([&](int l) { v[l] = 0; });
    }
    if (!piece.area) return;
    const double* const x = signal(piece.of.over);
    double *const x0 = at(x_start), *const xb = at(x_before), *const yb = at(y_before);
    each([&](int l) {
      x0[l] = x[l];
      xb[l] = yb[l] = 0;
    });
  }

  /// Straight from the row before to this one, seen from the first row, so that an offset costs no digits.
  void add_area() const {
    const double *const x = signal(piece.of.over), *const now = at(y), *const x0 = at(x_start), *const y0 = at(start);
    double *const xb = at(x_before), *const yb = at(y_before), *const v = at(twice);
    each([&](int l) {
      const double dx = x[l] - x0[l], dy = now[l] - y0[l];
      v[l] += xb[l] * dy - dx * yb[l];
      xb[l] = dx;
      yb[l] = dy;
    });
  }

  void add_extremes() const {
    const double* const now = at(y);
    double *const a = at(low), *const b = at(high);
    each([&](int l) {
      a[l] = now[l] < a[l] ? now[l] : a[l];
      b[l] = now[l] > b[l] ? now[l] : b[l];
    });
  }

  /// Welford, Technometrics 4 (1962) 419-420.
  void add_deviation() const {
    const double* const now = at(y);
    double *const m = at(middle), *const v = at(scatter);
    const auto rows = static_cast<double>(k - piece.of.first + 1);
    each([&](int l) {
      const double away = now[l] - m[l];
      m[l] += away / rows;
      v[l] += away * (now[l] - m[l]);
    });
  }

  void add_sums() const {
    const double* const now = at(y);
    double *const whole = at(finite), *const s = at(sum), *const q = at(square);
    // 0 as long as every row was finite: 0 times anything else is NaN, and stays.
    each([&](int l) { whole[l] += 0 * now[l]; });
    if (piece.mean) each([&](int l) { s[l] += now[l]; });
    if (piece.squares) each([&](int l) { q[l] += now[l] * now[l]; });
  }

  void keep(Number number) const {
    const double* const now = at(y);
    double* const v = at(number);
    each([&](int l) { v[l] = now[l]; });
  }

  void operator()() const {
    take();
    if (begins()) begin();
    add_sums();
    if (piece.extremes) add_extremes();
    if (piece.deviation) add_deviation();
    if (piece.area) add_area();
    if (k == piece.before) keep(y_a);
    if (k == piece.after) keep(y_b);
  }
};

struct AddRow {
  using Arguments = RowOf;
  static void run(const RowOf& row) { row(); }
};

/// Same rows of the same trace: what is taken of it may differ.
bool same_piece(const TraceFeature& a, const TraceFeature& b) {
  return a.signal == b.signal && a.minus == b.minus && a.less == b.less && a.first == b.first && a.last == b.last &&
         a.rezero == b.rezero && (a.over == b.over || a.over < 0 || b.over < 0);
}

}  // namespace

const std::vector<std::string>& trace_takes() {
  static const std::vector<std::string> names{"at",          "first", "last",      "min",       "max",
                                              "stroke",      "mean",  "rms",       "deviation", "max_abs",
                                              "sum_squares", "area",  "remanence", "overshoot"};
  return names;
}

Reducers::Reducers(const std::vector<TraceFeature>& features, std::vector<double> instants, int lanes)
    : lanes_(lanes), instants_(std::move(instants)), features_(features) {
  for (auto& f : features_) {
    if (f.take != Take::area) f.over = -1;
    if (f.take == Take::at) f.first = 0, f.last = static_cast<long>(instants_.size());  // which it is held beyond
    place_.push_back(piece_of(f));
  }
  for (auto& p : pieces_) p.numbers.assign(static_cast<std::size_t>(numbers) * static_cast<std::size_t>(lanes), 0.0);
}

int Reducers::piece_of(const TraceFeature& f) {
  std::size_t i = 0;
  const auto fits = [&](const TracePiece& p) { return f.take != Take::at && p.before < 0 && same_piece(p.of, f); };
  while (i < pieces_.size() && !fits(pieces_[i])) ++i;
  if (i == pieces_.size()) {
    pieces_.emplace_back();
    pieces_.back().of = f;
  }
  TracePiece& p = pieces_[i];
  switch (f.take) {
    case Take::min:
    case Take::max:
    case Take::stroke:
    case Take::max_abs:
    case Take::remanence:
    case Take::overshoot:
      p.extremes = true;
      break;
    case Take::mean:
      p.mean = true;
      break;
    case Take::rms:
    case Take::sum_squares:
      p.squares = true;
      break;
    case Take::deviation:
      p.deviation = true;
      break;
    case Take::area:
      p.area = true;
      p.of.over = f.over;
      break;
    case Take::at: {
      const long rows = static_cast<long>(instants_.size());
      const long after = std::lower_bound(instants_.begin(), instants_.end(), f.at) - instants_.begin();
      p.before = std::clamp(after - 1, 0L, rows - 1);
      p.after = std::clamp(after, 0L, rows - 1);
      if (p.before < p.after) {
        p.along = f.at - instants_[static_cast<std::size_t>(p.before)];
        p.step = instants_[static_cast<std::size_t>(p.after)] - instants_[static_cast<std::size_t>(p.before)];
      }
      break;
    }
    default:
      break;
  }
  return static_cast<int>(i);
}

void Reducers::row(long k, const double* signals) {
  static const auto add = SimdDispatch<AddRow>::on_this_processor();
  for (auto& p : pieces_) {
    if (k < p.of.first || k >= p.of.last) continue;
    if (p.before >= 0 && k != p.of.first && k != p.before && k != p.after) continue;  // of at: needs no others
    add({p, k, signals, lanes_});
  }
}

double Reducers::value(const TraceFeature& f, const TracePiece& p, int lane) const {
  const auto number = [&](Number n) { return p.numbers[static_cast<std::size_t>(n * lanes_ + lane)]; };
  if (number(finite) != 0) return std::numeric_limits<double>::quiet_NaN();
  const auto rows = static_cast<double>(p.of.last - p.of.first);
  const double end = number(y);
  switch (f.take) {
    case Take::at:
      return number(y_a) + (number(y_b) - number(y_a)) * p.along / p.step;
    case Take::first:
      return number(start);
    case Take::last:
      return end;
    case Take::min:
      return number(low);
    case Take::max:
      return number(high);
    case Take::stroke:
      return number(high) - number(low);
    case Take::mean:
      return number(sum) / rows;
    case Take::rms:
      return std::sqrt(number(square) / rows);
    case Take::deviation:
      return std::sqrt(number(scatter) / rows);
    case Take::max_abs:
      return std::max(std::abs(number(low)), std::abs(number(high)));
    case Take::sum_squares:
      return number(square);
    case Take::area:
      return number(twice) / 2;
    case Take::remanence:
      return number(high) == 0 ? 0 : (end - number(start)) / number(high);
    case Take::overshoot: {
      const double step = end - number(start);
      if (step == 0) return 0;
      return std::max(0.0, ((step > 0 ? number(high) : number(low)) - end) / step);
    }
  }
  return std::numeric_limits<double>::quiet_NaN();
}

void Reducers::values(double* values) const {
  for (std::size_t f = 0; f < features_.size(); ++f)
    for (int l = 0; l < lanes_; ++l)
      values[f * static_cast<std::size_t>(lanes_) + static_cast<std::size_t>(l)] =
          value(features_[f], pieces_[static_cast<std::size_t>(place_[f])], l);
}

}  // namespace hysteron
