// Every operation is written once, for a length known at compile time (`fixed`) or not (fixed = 0). z may be one of the
// operands, as SUNDIALS allows; it never overlaps one otherwise.
#include "engine/integrators/vector_operations.h"

#include <nvector/nvector_serial.h>

#include <array>
#include <cmath>
#include <utility>

// Chosen once, when the program is loaded. Sanitizers instrument that choice before they can run.
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define HYSTERON_WIDE [[gnu::target_clones("avx2", "default")]]
#else
#define HYSTERON_WIDE
#endif

namespace hysteron {
namespace {

constexpr int longest_fixed = 10;
constexpr int lanes = 8;  // partial sums of a long vector

double* data(N_Vector v) { return NV_DATA_S(v); }

template <int fixed>
[[gnu::always_inline]] inline sunindextype length(N_Vector v) {
  if constexpr (fixed > 0)
    return fixed;
  else
    return NV_LENGTH_S(v);
}

/// f(i) for every element, in any order.
template <int fixed, class F>
[[gnu::always_inline]] inline void each(sunindextype n, F f) {
#pragma GCC ivdep
  for (sunindextype i = 0; i < (fixed > 0 ? fixed : n); ++i) f(i);
}

/// Sum of f(i). Short: from the first to the last; long: element i belongs to partial sum i mod 8.
template <int fixed, class F>
[[gnu::always_inline]] inline double sum(sunindextype n, F f) {
  if constexpr (fixed > 0) {
    double s = f(0);
    for (int i = 1; i < fixed; ++i) s += f(i);
    return s;
  } else {
    double s[lanes] = {};
    sunindextype i = 0;
    for (; i + lanes <= n; i += lanes)
      for (int l = 0; l < lanes; ++l) s[l] += f(i + l);
    for (int l = 0; i < n; ++i, ++l) s[l] += f(i);
    return ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]));
  }
}

/// z = sum of c_k x(k), in one pass over the elements, so that z may be any of the x(k).
template <int fixed, class X>
[[gnu::always_inline]] inline void combine(int count, const double* c, X x, double* z, sunindextype n) {
  constexpr int width = fixed > 0 ? fixed : lanes;
  sunindextype i = 0;
  for (; i + width <= n; i += width) {
    double s[width];
    const double* x0 = x(0) + i;
    for (int l = 0; l < width; ++l) s[l] = c[0] * x0[l];
    for (int k = 1; k < count; ++k) {
      const double* xk = x(k) + i;
      for (int l = 0; l < width; ++l) s[l] += c[k] * xk[l];
    }
    for (int l = 0; l < width; ++l) z[i + l] = s[l];
  }
  for (; i < n; ++i) {
    double s = c[0] * x(0)[i];
    for (int k = 1; k < count; ++k) s += c[k] * x(k)[i];
    z[i] = s;
  }
}

template <int fixed>
struct Operations {
  HYSTERON_WIDE static void linear_sum(double a, N_Vector x_, double b, N_Vector y_, N_Vector z_) {
    const double *x = data(x_), *y = data(y_);
    double* z = data(z_);
    each<fixed>(length<fixed>(z_), [=](auto i) { z[i] = a * x[i] + b * y[i]; });
  }
  HYSTERON_WIDE static void constant(double c, N_Vector z_) {
    double* z = data(z_);
    each<fixed>(length<fixed>(z_), [=](auto i) { z[i] = c; });
  }
  HYSTERON_WIDE static void product(N_Vector x_, N_Vector y_, N_Vector z_) {
    const double *x = data(x_), *y = data(y_);
    double* z = data(z_);
    each<fixed>(length<fixed>(z_), [=](auto i) { z[i] = x[i] * y[i]; });
  }
  HYSTERON_WIDE static void quotient(N_Vector x_, N_Vector y_, N_Vector z_) {
    const double *x = data(x_), *y = data(y_);
    double* z = data(z_);
    each<fixed>(length<fixed>(z_), [=](auto i) { z[i] = x[i] / y[i]; });
  }
  HYSTERON_WIDE static void scale(double c, N_Vector x_, N_Vector z_) {
    const double* x = data(x_);
    double* z = data(z_);
    each<fixed>(length<fixed>(z_), [=](auto i) { z[i] = c * x[i]; });
  }
  HYSTERON_WIDE static void absolute(N_Vector x_, N_Vector z_) {
    const double* x = data(x_);
    double* z = data(z_);
    each<fixed>(length<fixed>(z_), [=](auto i) { z[i] = std::abs(x[i]); });
  }
  HYSTERON_WIDE static void inverse(N_Vector x_, N_Vector z_) {
    const double* x = data(x_);
    double* z = data(z_);
    each<fixed>(length<fixed>(z_), [=](auto i) { z[i] = 1 / x[i]; });
  }
  HYSTERON_WIDE static void add_constant(N_Vector x_, double b, N_Vector z_) {
    const double* x = data(x_);
    double* z = data(z_);
    each<fixed>(length<fixed>(z_), [=](auto i) { z[i] = x[i] + b; });
  }
  HYSTERON_WIDE static double dot(N_Vector x_, N_Vector y_) {
    const double *x = data(x_), *y = data(y_);
    return sum<fixed>(length<fixed>(x_), [=](auto i) { return x[i] * y[i]; });
  }
  HYSTERON_WIDE static double largest(N_Vector x_) {
    const double* x = data(x_);
    const auto n = length<fixed>(x_);
    double m = 0;
    for (sunindextype i = 0; i < n; ++i) m = std::abs(x[i]) > m ? std::abs(x[i]) : m;
    return m;
  }
  HYSTERON_WIDE static double weighted_norm(N_Vector x_, N_Vector w_) {
    const double *x = data(x_), *w = data(w_);
    const auto n = length<fixed>(x_);
    const auto square = [=](auto i) {
      const double v = x[i] * w[i];
      return v * v;
    };
    return std::sqrt(sum<fixed>(n, square) / static_cast<double>(n));
  }

  HYSTERON_WIDE static int linear_combination(int count, double* c, N_Vector* x, N_Vector z) {
    combine<fixed>(
        count, c, [x](int k) { return data(x[k]); }, data(z), length<fixed>(z));
    return 0;
  }
  /// z_k = a_k x + y_k
  HYSTERON_WIDE static int scale_add_multi(int count, double* a, N_Vector x_, N_Vector* y_, N_Vector* z_) {
    const double* x = data(x_);
    const auto n = length<fixed>(x_);
    for (int k = 0; k < count; ++k) {
      const double* y = data(y_[k]);
      double* z = data(z_[k]);
      const double ak = a[k];
      each<fixed>(n, [=](auto i) { z[i] = ak * x[i] + y[i]; });
    }
    return 0;
  }

  // The same for arrays of vectors: the states' sensitivities, one vector per parameter.
  static int linear_sums(int count, double a, N_Vector* x, double b, N_Vector* y, N_Vector* z) {
    for (int k = 0; k < count; ++k) linear_sum(a, x[k], b, y[k], z[k]);
    return 0;
  }
  static int scales(int count, double* c, N_Vector* x, N_Vector* z) {
    for (int k = 0; k < count; ++k) scale(c[k], x[k], z[k]);
    return 0;
  }
  static int constants(int count, double c, N_Vector* z) {
    for (int k = 0; k < count; ++k) constant(c, z[k]);
    return 0;
  }
  static int weighted_norms(int count, N_Vector* x, N_Vector* w, double* norm) {
    for (int k = 0; k < count; ++k) norm[k] = weighted_norm(x[k], w[k]);
    return 0;
  }
  static int scale_adds(int count, int sums, double* a, N_Vector* x, N_Vector** y, N_Vector** z) {
    for (int j = 0; j < sums; ++j)
      for (int k = 0; k < count; ++k) linear_sum(a[j], x[k], 1, y[j][k], z[j][k]);
    return 0;
  }
  HYSTERON_WIDE static int linear_combinations(int count, int terms, double* c, N_Vector** x, N_Vector* z) {
    for (int k = 0; k < count; ++k)
      combine<fixed>(
          terms, c, [x, k](int j) { return data(x[j][k]); }, data(z[k]), length<fixed>(z[k]));
    return 0;
  }

  static void put_into(N_Vector v) {
    auto& o = *v->ops;
    o.nvlinearsum = &linear_sum;
    o.nvconst = &constant;
    o.nvprod = &product;
    o.nvdiv = &quotient;
    o.nvscale = &scale;
    o.nvabs = &absolute;
    o.nvinv = &inverse;
    o.nvaddconst = &add_constant;
    o.nvdotprod = &dot;
    o.nvmaxnorm = &largest;
    o.nvwrmsnorm = &weighted_norm;
    o.nvlinearcombination = &linear_combination;
    o.nvscaleaddmulti = &scale_add_multi;
    o.nvlinearsumvectorarray = &linear_sums;
    o.nvscalevectorarray = &scales;
    o.nvconstvectorarray = &constants;
    o.nvwrmsnormvectorarray = &weighted_norms;
    o.nvscaleaddmultivectorarray = &scale_adds;
    o.nvlinearcombinationvectorarray = &linear_combinations;
  }
};

template <int... n>
constexpr auto table(std::integer_sequence<int, n...>) {
  return std::array{&Operations<n>::put_into...};
}

HYSTERON_WIDE void weigh(double relative, const double* absolute, const double* x, double* w, sunindextype n) {
  each<0>(n, [=](auto i) { w[i] = 1 / (relative * std::abs(x[i]) + absolute[i]); });
}

}  // namespace

void use_own_operations(N_Vector v) {
  static constexpr auto for_length = table(std::make_integer_sequence<int, longest_fixed + 1>());
  const auto n = NV_LENGTH_S(v);
  for_length[n <= longest_fixed ? static_cast<std::size_t>(n) : 0](v);
}

void error_weights(double relative, const double* absolute, N_Vector x, N_Vector weights) {
  weigh(relative, absolute, data(x), data(weights), NV_LENGTH_S(x));
}

}  // namespace hysteron
