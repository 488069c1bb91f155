#include "engine/lanes/lane_arithmetic.h"

#include "engine/block/simd_dispatch.h"

namespace hysteron {
namespace {

struct Fill {
  using Arguments = LaneFill;
  static void run(const LaneFill& a) {
    double* to = a.to;
    const double value = a.value;
    for (std::size_t i = 0; i < a.count; ++i) to[i] = value;
  }
};
struct Move {
  using Arguments = LaneMove;
  static void run(const LaneMove& a) {
    const LaneMove b = a;
#pragma GCC ivdep
    for (std::size_t i = 0; i < b.count; ++i) b.to[i] = b.from[i] + b.h * b.slope[i];
  }
};
struct Combine {
  using Arguments = LaneCombination;
  static void run(const LaneCombination& a) {
    const LaneCombination b = a;
#pragma GCC ivdep
    for (std::size_t i = 0; i < b.count; ++i) b.x[i] = b.x[i] + b.h / 6 * (b.k1[i] + 2 * (b.k2[i] + b.k3[i]) + b.k4[i]);
  }
};

struct Watch {
  using Arguments = LaneSum;
  static void run(const LaneSum& a) {
    const LaneSum b = a;
#pragma GCC ivdep
    for (std::size_t i = 0; i < b.count; ++i) b.sum[i] += 0 * b.y[i];
  }
};

}  // namespace

void lane_fill(const LaneFill& a) {
  static const auto call = SimdDispatch<Fill>::on_this_processor();
  call(a);
}
void lane_move(const LaneMove& a) {
  static const auto call = SimdDispatch<Move>::on_this_processor();
  call(a);
}
void lane_combine(const LaneCombination& a) {
  static const auto call = SimdDispatch<Combine>::on_this_processor();
  call(a);
}

void lane_watch(const LaneSum& a) {
  static const auto call = SimdDispatch<Watch>::on_this_processor();
  call(a);
}

}  // namespace hysteron
