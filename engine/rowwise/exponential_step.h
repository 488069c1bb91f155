// Decides a Runge-Kutta step of order four of a small system dx/dt = f(place, x) of which a linear part A is taken
// exactly, however quickly that decays: where f is A x and a parabola in time, the step is exact. Internal to the exact
// advance.
#pragma once

#include <array>
#include <vector>

namespace hysteron {

class ExponentialStep {
 public:
  static constexpr int most_states = 8;

  /// slopes: A, n rows one behind the other.
  ExponentialStep(int n, std::vector<double> slopes);

  /// What grows exactly is cancelled by the rest of f where f does not grow so everywhere. Largest real part of the
  /// eigenvalues of A [1/s]; not a number where A is none.
  double growth() const { return growth_; }
  /// Largest size of the eigenvalues [1/s].
  double fastest() const { return fastest_; }

  /// Moves x by h [s], a whole row or a part of one, of which no two are of one length; rates(place, x, dx): f at a
  /// place from 0, the beginning, to 1, the end. Source: Cox, Matthews, J. Comput. Phys. 176 (2002) 430-455, ETD4RK,
  /// written for the way from the beginning.
  template <class Rates>
  void operator()(double* x, double h, bool whole_row, const Rates& rates) {
    using Vector = std::array<double, most_states>;
    const Lengths& m = whole_row ? of_row(h) : of_part(h);
    Vector first, there, rate, way_a, way_b, way_c, left_a, left_b, left_c;
    const auto left = [&](double place, const Vector& way, Vector& to) {  // f there but for f at the beginning and A
      for (int i = 0; i < n_; ++i) there[i] = x[i] + way[i];
      rates(place, there.data(), rate.data());
      times(slopes_, way.data(), to.data());
      for (int i = 0; i < n_; ++i) to[i] = rate[i] - first[i] - to[i];
    };
    rates(0.0, x, first.data());
    times(m.half, first.data(), way_a.data());
    left(0.5, way_a, left_a);
    times(m.half, left_a.data(), way_b.data());
    for (int i = 0; i < n_; ++i) way_b[i] += way_a[i];
    left(0.5, way_b, left_b);
    for (int i = 0; i < n_; ++i) there[i] = first[i] + 2 * left_b[i];
    times(m.half, there.data(), way_c.data());
    times(m.decay, way_a.data(), there.data());
    for (int i = 0; i < n_; ++i) way_c[i] += there[i];
    left(1.0, way_c, left_c);
    for (int i = 0; i < n_; ++i) left_a[i] += left_b[i];
    times(m.whole, first.data(), way_a.data());
    times(m.middle, left_a.data(), way_b.data());
    times(m.last, left_c.data(), way_c.data());
    for (int i = 0; i < n_; ++i) x[i] += way_a[i] + way_b[i] + way_c[i];
  }

  /// The same where f is A x and what moves along a straight line with the place.
  template <class Rates>
  void along_a_line(double* x, double h, bool whole_row, const Rates& rates) {
    const Lengths& m = whole_row ? of_row(h) : of_part(h);
    std::array<double, most_states> first, last, constant, rise;
    rates(0.0, x, first.data());
    rates(1.0, x, last.data());
    for (int i = 0; i < n_; ++i) last[i] -= first[i];
    times(m.whole, first.data(), constant.data());
    times(m.ramp, last.data(), rise.data());
    for (int i = 0; i < n_; ++i) x[i] += constant[i] + rise[i];
  }

 private:
  /// Of one length h, with phi_k(z) = sum z^j/(j + k)!: exp(A h/2), h/2 phi_1(A h/2), h phi_1, h phi_2, 2 h (phi_2 - 2
  /// phi_3), h (4 phi_3 - phi_2) at A h.
  struct Lengths {
    double h = -1;
    std::vector<double> decay, half, whole, ramp, middle, last;
  };
  const Lengths& of_row(double h);
  const Lengths& of_part(double h);
  void make(Lengths& m, double h) const;
  template <int N>
  void make_of(Lengths& m, double h) const;
  void times(const std::vector<double>& matrix, const double* x, double* y) const {
    const double* a = matrix.data();
    for (int i = 0; i < n_; ++i, a += n_) {
      double sum = 0;
      for (int j = 0; j < n_; ++j) sum += a[j] * x[j];
      y[i] = sum;
    }
  }

  int n_;
  std::vector<double> slopes_;
  double growth_ = 0, fastest_ = 0;
  Lengths row_, part_;  // rows are of one length, most of the time
};

}  // namespace hysteron
