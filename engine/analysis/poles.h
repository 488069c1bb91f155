// Decides the eigenvalues of a real matrix and how well each is known. Knows no diagrams.
#pragma once

#include <complex>
#include <span>
#include <vector>

namespace hysteron {

/// Factors f (powers of two) that give rows and columns of the n x n matrix `a` (by rows) like sizes: with x_i = f_i *
/// new x_i its entries become a_ij f_j / f_i.
std::vector<double> balancing(std::span<const double> a, int n);

struct Eigenvalue {
  std::complex<double> value;
  double error = 0;  ///< as far off as rounding may have moved it (first order: condition times rounding)
};

/// Eigenvalues of the n x n matrix `a` (by rows), by falling real part. Parts of the matrix that do not need each other
/// are taken one by one (a chain of integrators gives zeros, not roots of the rounding), rows and columns are balanced.
/// Source: Parlett, Reinsch, Numer. Math. 13 (1969) 293-304; Golub, Van Loan, Matrix Computations, 4th ed.
/// (2013), 7.2.2.
std::vector<Eigenvalue> eigenvalues(std::span<const double> a, int n);

/// Where eigenvalues lie against a limit of stability: the imaginary axis, or the unit circle.
struct PoleCount {
  int outside = 0;       ///< unstable ones
  int on_the_limit = 0;  ///< as far as rounding lets one tell
  bool endless = false;  ///< infinitely many outside: a dead time in a loop whose gain does not fall with the frequency
  bool stable() const { return outside == 0 && on_the_limit == 0 && !endless; }
};
PoleCount right_of_the_axis(std::span<const Eigenvalue> list);
PoleCount outside_the_circle(std::span<const Eigenvalue> list);

}  // namespace hysteron
