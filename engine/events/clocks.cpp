#include "engine/events/clocks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "engine/events/enabled.h"
#include "engine/program/breakpoints.h"

namespace hysteron {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::int64_t largest = std::int64_t{1} << 53;  // ticks that a double still counts

double parameter(const Program& program, const Run& run, int block, const char* name) {
  const auto& b = program.blocks[static_cast<std::size_t>(block)];
  const auto i = static_cast<std::size_t>(b.kernel->declaration.parameter_index(name));
  return run.p[static_cast<std::size_t>(b.p_begin + b.p_at[i])];
}

}  // namespace

Fraction nearest_fraction(double x) {
  constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
  Fraction before{0, 1}, now{1, 0};
  for (double rest = x;;) {
    const double whole = std::floor(rest);
    const double n = whole * static_cast<double>(now.n) + static_cast<double>(before.n);
    const double d = whole * static_cast<double>(now.d) + static_cast<double>(before.d);
    if (!(n < static_cast<double>(largest) && d < static_cast<double>(largest))) return {0, 0};
    before = std::exchange(now, {static_cast<std::int64_t>(n), static_cast<std::int64_t>(d)});
    if (std::abs(x - n / d) <= rounding * x) return now;
    rest = 1 / (rest - whole);
  }
}

Clocking clocking_of(const Program& program, const Run& run, int block) {
  return {nearest_fraction(parameter(program, run, block, "period")),
          nearest_fraction(parameter(program, run, block, "offset"))};
}

Clocks::Clocks(const Program& program, const Run& run, double begin) {
  std::vector<Clocking> given;
  std::vector<int> clocked;  // places in program.sampled_blocks: the others run at the edges of a trigger
  Problems problems;
  for (std::size_t i = 0; i < program.sampled_blocks.size(); ++i) {
    const int block = program.sampled_blocks[i];
    if (runs_at_edges(program, program.blocks[static_cast<std::size_t>(block)])) continue;
    clocked.push_back(static_cast<int>(i));
    given.push_back(clocking_of(program, run, block));
    for (const auto& f : {given.back().period, given.back().offset}) {
      const std::int64_t common = f.d == 0 ? 0 : ticks_per_second_ / std::gcd(ticks_per_second_, f.d);
      if (common == 0 || common > largest / f.d) {
        problems.add("no_common_clock", program.blocks[static_cast<std::size_t>(block)].path,
                     "period and offset have no tick in common with those of the other sampled blocks",
                     "write periods that are whole multiples of each other, such as \"0.1 ms\" and \"20 ms\"");
        break;
      }
      ticks_per_second_ = common * f.d;
    }
  }
  problems.throw_if_any();
  const auto ticks = [&](const Fraction& f) { return f.n * (ticks_per_second_ / f.d); };
  for (std::size_t i = 0; i < given.size(); ++i) {
    Clock clock{ticks(given[i].period), ticks(given[i].offset), 0, {}};
    const auto same = std::find_if(clocks_.begin(), clocks_.end(), [&](const Clock& c) {
      return c.period == clock.period && c.offset == clock.offset;
    });
    if (same != clocks_.end()) {
      same->members.push_back(clocked[i]);
      continue;
    }
    clock.members = {clocked[i]};
    clock.next = clock.offset;
    const double late = (begin - time(clock.offset)) / time(clock.period);
    if (late > 0) clock.next += clock.period * static_cast<std::int64_t>(std::ceil(late * (1 - 1e-12)));
    clocks_.push_back(clock);
  }
}

double Clocks::time(std::int64_t ticks) const {
  return static_cast<double>(ticks) / static_cast<double>(ticks_per_second_);
}

double Clocks::next() const {
  double first = infinity;
  for (const auto& clock : clocks_) first = std::min(first, time(clock.next));
  return first;
}

const std::vector<int>& Clocks::take(double t, Run& run) {
  due_.clear();
  for (auto& clock : clocks_) {
    if (time(clock.next) > t + same_instant(t)) continue;
    for (const int member : clock.members) {
      due_.push_back(member);
      run.hits[static_cast<std::size_t>(member)] = static_cast<long>((clock.next - clock.offset) / clock.period);
    }
    clock.next += clock.period;
  }
  return due_;
}

}  // namespace hysteron
