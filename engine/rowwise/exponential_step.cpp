#include "engine/rowwise/exponential_step.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace hysteron {
namespace {

/// Of N states, or of any number up to the most.
template <int N>
using Square = Eigen::Matrix<double, N, N, Eigen::RowMajor, N == Eigen::Dynamic ? ExponentialStep::most_states : N,
                             N == Eigen::Dynamic ? ExponentialStep::most_states : N>;

/// phi_0 to phi_3 of a matrix.
template <class Matrix>
struct Phi {
  Matrix exp, one, two, three;

  /// A matrix of norm 1/2 at most: fourteen terms leave 2^-14/17! = 2e-19.
  explicit Phi(const Matrix& z) {
    const auto n = z.rows();
    const Matrix identity = Matrix::Identity(n, n);
    three = Matrix::Zero(n, n);
    double factorial = 6;  // (j + 3)!
    for (int j = 1; j < 14; ++j) factorial *= j + 3;
    for (int j = 13; j >= 0; factorial /= j + 3, --j) three = z * three + identity / factorial;
    two = z * three + identity / 2;
    one = z * two + identity;
    exp = z * one + identity;
  }
  /// Of twice the matrix. Source: Skaflestad, Wright, Appl. Numer. Math. 59 (2009) 783-799.
  void turn_to_double() {
    three = (exp * three + three + two + one / 2).eval() / 8;
    two = (exp * two + two + one).eval() / 4;
    one = (exp * one + one).eval() / 2;
    exp = (exp * exp).eval();
  }
};

template <class Matrix>
void put(const Matrix& from, std::vector<double>& to) {
  to.assign(from.data(), from.data() + from.size());
}

}  // namespace

ExponentialStep::ExponentialStep(int n, std::vector<double> slopes) : n_(n), slopes_(std::move(slopes)) {
  const Eigen::MatrixXd a = Eigen::Map<const Eigen::MatrixXd>(slopes_.data(), n_, n_);  // or its transpose
  growth_ = fastest_ = std::numeric_limits<double>::quiet_NaN();
  if (!a.allFinite()) return;
  const Eigen::VectorXcd eigenvalues = a.eigenvalues();
  growth_ = eigenvalues.real().maxCoeff();
  fastest_ = eigenvalues.cwiseAbs().maxCoeff();
}

const ExponentialStep::Lengths& ExponentialStep::of_row(double h) {
  if (!(std::abs(row_.h - h) <= 1e-9 * h)) make(row_, h);  // times read from text differ in their last digits only
  return row_;
}

const ExponentialStep::Lengths& ExponentialStep::of_part(double h) {
  if (part_.h != h) make(part_, h);
  return part_;
}

void ExponentialStep::make(Lengths& m, double h) const {
  switch (n_) {
    case 1:
      return make_of<1>(m, h);
    case 2:
      return make_of<2>(m, h);
    case 3:
      return make_of<3>(m, h);
    case 4:
      return make_of<4>(m, h);
    default:
      return make_of<Eigen::Dynamic>(m, h);
  }
}

template <int N>
void ExponentialStep::make_of(Lengths& m, double h) const {
  using Matrix = Square<N>;
  const Matrix a = Eigen::Map<const Matrix>(slopes_.data(), n_, n_);
  const double size = h * a.cwiseAbs().rowwise().sum().maxCoeff();
  const int doublings = size > 0.5 ? std::max(1, std::ilogb(size) + 2) : 1;
  Phi<Matrix> phi(a * std::ldexp(h, -doublings));
  for (int i = 1; i < doublings; ++i) phi.turn_to_double();
  m.h = h;
  put(phi.exp, m.decay);
  put(Matrix(phi.one * (h / 2)), m.half);
  phi.turn_to_double();
  put(Matrix(phi.one * h), m.whole);
  put(Matrix(phi.two * h), m.ramp);
  put(Matrix((phi.two - 2 * phi.three) * (2 * h)), m.middle);
  put(Matrix((4 * phi.three - phi.two) * h), m.last);
}

}  // namespace hysteron
