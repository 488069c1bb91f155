// The slopes of every block's functions are exact: held against central differences along one direction in its inputs
// and states, and for the laws below in their parameters too.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "models/random.h"
#include "tests/blocks/samples.h"

namespace hysteron {
namespace {

using bench::Bench;
using bench::moved;
using bench::Numbers;
using Jets = std::vector<Jet>;

Numbers drawn(std::size_t n, std::uint64_t stream, double scale) {
  Numbers v;
  for (std::size_t i = 0; i < n; ++i) v.push_back(scale * random::normal(17, stream, i));
  return v;
}
Jets along(const Numbers& a, const Numbers& direction) {
  Jets b;
  for (std::size_t i = 0; i < a.size(); ++i) {
    b.emplace_back(a[i]);
    b.back().slope[3] = direction[i];  // any of the directions
  }
  return b;
}

/// Point and direction for all arguments of a block's functions.
struct Point {
  Numbers p, u, x, m, du;
};
Point moved(const Point& a, const Point& d, double h) {
  return {moved(a.p, d.p, h), moved(a.u, d.u, h), moved(a.x, d.x, h), moved(a.m, d.m, h), moved(a.du, d.du, h)};
}

class SlopesOfEverySample : public testing::TestWithParam<bench::Sample> {
 protected:
  template <class T>
  static View<T> view(const Bench& b, const std::vector<T>& p, const std::vector<T>& u, const std::vector<T>& x,
                      const std::vector<T>& m, const std::vector<T>& du) {
    View<T> v;
    v.p = p.data();
    v.p_at = b.p_at.data();
    v.c = b.c.data();
    v.n_c = b.sizes.constants;
    v.x = x.data();
    v.n_x = b.states();
    v.m = m.data();
    v.n_m = b.sizes.memory;
    v.u = u.data();
    v.du = du.data();
    v.n_u = b.n_u;
    v.n_y = b.sizes.outputs;
    v.t = T{0.37};
    v.branch = 0.37;
    v.mode = b.mode;
    v.history = b.history;
    return v;
  }
  void compare(const Bench& b, const char* what, Functions<double>::Call plain, Functions<Jet>::Call slopes, int count,
               const Point& at, const Point& direction) const {
    if (plain == nullptr) return;
    ASSERT_NE(slopes, nullptr) << what;
    // 1e-4: curvature 1e-8; laws that are integrated to 1e-10 of their way leave 1e-6
    const double h = 1e-4;
    const auto values = [&](double e) {
      const Point q = moved(at, direction, e);
      Numbers out(static_cast<std::size_t>(count));
      View<double> v = view<double>(b, q.p, q.u, q.x, q.m, q.du);
      v.out = out.data();
      plain(v);
      return out;
    };
    const Jets p = along(at.p, direction.p), u = along(at.u, direction.u), x = along(at.x, direction.x),
               m = along(at.m, direction.m), du = along(at.du, direction.du);
    Jets out(static_cast<std::size_t>(count));
    View<Jet> v = view<Jet>(b, p, u, x, m, du);
    v.out = out.data();
    slopes(v);
    const Numbers here = values(0), up = values(h), down = values(-h);
    for (std::size_t i = 0; i < out.size(); ++i) {
      const double difference = (up[i] - down[i]) / (2 * h);
      EXPECT_NEAR(out[i].value, here[i], 1e-13 * (1 + std::fabs(here[i]))) << what << " " << i;
      EXPECT_NEAR(out[i].slope[3], difference, 3e-6 * (1 + std::fabs(difference))) << what << " " << i;
      for (int k = 0; k < Jet::directions; ++k)
        if (k != 3) {
          EXPECT_EQ(out[i].slope[k], 0) << what << ": a direction of its own";
        }
    }
  }
};

TEST_P(SlopesOfEverySample, CarriesTheExactSlopesOfItsFunctions) {
  Bench b(GetParam().type, GetParam().values, GetParam().inputs);
  const History history{{0, 0.1, 0.4, 0.9}, {0, 1, 0.5, 2}, {3, -1, 2, 1}, 0, 0};
  b.history = &history;
  // Blocks whose parameters act through their laws alone; the others prepare constants, which carry no slopes.
  const std::set<std::string> whole{"jiles_atherton",
                                    "jiles_atherton_inverse",
                                    "sampled_jiles_atherton_inverse",
                                    "rate_limiter",
                                    "current_limit",
                                    "prandtl_ishlinskii_inverse",
                                    "mass_with_friction",
                                    "mass_with_stops",
                                    "mass_on_stiffening_spring",
                                    "duffing",
                                    "mass_spring_damper",
                                    "discrete_transfer_function",
                                    "backlash",
                                    "lead_lag",
                                    "notch",
                                    "second_order",
                                    "biquads",
                                    "fir",
                                    "discrete_integrator",
                                    "winding",
                                    "voice_coil",
                                    "h_bridge",
                                    "synchronous_motor",
                                    "stepper_motor",
                                    "battery_cell",
                                    "pendulum",
                                    "propeller",
                                    "linear_encoder",
                                    "disturbance_observer",
                                    "relay"};
  const auto nu = static_cast<std::size_t>(b.n_u), nx = static_cast<std::size_t>(b.states()),
             nm = static_cast<std::size_t>(b.sizes.memory);
  const int modes = !b.kernel.has_modes()                  ? 1
                    : GetParam().type == "mass_with_stops" ? 4
                    : GetParam().type == "relay"           ? 2
                                                           : 3;
  for (std::uint64_t trial = 0; trial < 20; ++trial)
    for (b.mode = 0; b.mode < modes; ++b.mode) {
      Point at{b.p, drawn(nu, 10 * trial, 1), drawn(nx, 10 * trial + 1, 1), drawn(nm, 10 * trial + 2, 1),
               drawn(nu, 10 * trial + 3, 1)};
      // Temperatures are absolute; where a block has one it is its last input.
      if (const auto& ports = b.kernel.declaration.inputs; !ports.empty() && ports.back().unit == "K")
        at.u.back() = 0.1 + std::fabs(at.u.back());
      if (GetParam().type == "divide") at.u.back() = 0.5 + std::fabs(at.u.back());  // away from its pole
      Point direction{Numbers(b.p.size(), 0.0), drawn(nu, 10 * trial + 4, 1), drawn(nx, 10 * trial + 5, 1),
                      drawn(nm, 10 * trial + 6, 1), drawn(nu, 10 * trial + 7, 1)};
      if (whole.contains(GetParam().type))
        for (std::size_t i = 0; i < b.kernel.declaration.parameters.size(); ++i)
          if (b.kernel.declaration.parameters[i].kind != ParameterKind::text)
            for (int k = b.p_at[i]; k < b.p_at[i + 1]; ++k)
              direction.p[static_cast<std::size_t>(k)] =
                  b.p[static_cast<std::size_t>(k)] * random::normal(23, trial, static_cast<std::uint64_t>(k)) / 10;
      const auto& slopes = b.kernel.jet;
      compare(b, "output", b.kernel.output, slopes.output, b.sizes.outputs, at, direction);
      compare(b, "derivative", b.kernel.derivative, slopes.derivative, b.sizes.states, at, direction);
      compare(b, "advance", b.kernel.advance, slopes.advance, b.sizes.memory, at, direction);
      compare(b, "update", b.kernel.update, slopes.update, b.sizes.sampled_states, at, direction);
      compare(b, "guard", b.kernel.guard, slopes.guard, 1, at, direction);
    }
}
INSTANTIATE_TEST_SUITE_P(Blocks, SlopesOfEverySample, testing::ValuesIn(bench::samples()), bench::sample_name);

}  // namespace
}  // namespace hysteron
