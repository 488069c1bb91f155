// Jiles-Atherton loops in many random parameter sets: two periods of 2000 points, fixed steps, one and two threads,
// against a loop by hand in vectors. CPU time on one thread, wall time on two; medians of repetitions in turn.
#include <time.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <thread>

#include "benchmarks/diagrams.h"
#include "benchmarks/many_loops_by_hand.h"
#include "engine/lanes/lanes.h"
#include "models/random.h"

namespace hysteron::benchmarks {
namespace {

constexpr std::size_t sets = 64 * 64;
constexpr int repetitions = 9;

std::vector<LoopNumbers> draws() {
  constexpr std::array<std::array<double, 2>, 5> range{{{5, 15}, {2, 6}, {0.01, 0.2}, {0.5, 3}, {0.05, 0.6}}};
  std::vector<LoopNumbers> list(sets);
  for (std::size_t i = 0; i < sets; ++i)
    for (std::size_t k = 0; k < 5; ++k)
      list[i][k] = range[k][0] + (range[k][1] - range[k][0]) * random::uniform(1, k, i);
  return list;
}

Lanes lanes_with(Method method) {
  Diagram d;
  d.blocks["u"] = node("sine", {{"amplitude", "3 V"}, {"offset", "3 V"}, {"frequency", "1 Hz"}, {"phase", "-90 deg"}});
  d.blocks["law"] =
      node("jiles_atherton", {{"p_s", "10 um"}, {"a", "4 V"}, {"alpha", "0.1 V/um"}, {"k", "1 V"}, {"c", 0.3}}, {"u"});
  d.record = {"law"};
  const auto program = compiled(d);
  std::vector<int> parameters;
  for (const char* name : {"law.p_s", "law.a", "law.alpha", "law.k", "law.c"})
    parameters.push_back(static_cast<int>(program->find_parameter(name) - program->parameters.data()));
  return {program, start(*program), {.until = 2, .every = 0.5, .method = method, .step = 1.0 / 2000}, parameters};
}

void in_lanes(Lanes& lanes, std::span<const LoopNumbers> numbers, std::span<LoopPoints> points) {
  std::vector<double> values(Lanes::width * 5);
  for (std::size_t first = 0; first < numbers.size(); first += Lanes::width) {
    for (std::size_t l = 0; l < Lanes::width; ++l) {
      const auto& n = numbers[first + l];
      const std::array<double, 5> si{n[0] * um, n[1], n[2] / um, n[3], n[4]};
      std::copy(si.begin(), si.end(), values.begin() + static_cast<std::ptrdiff_t>(5 * l));
    }
    lanes(values, [&](long row, double, const double* p) {
      if (row < 2) return;
      for (std::size_t l = 0; l < Lanes::width; ++l) points[first + l].p[static_cast<std::size_t>(row - 2)] = p[l] / um;
    });
  }
}

double cpu_now() {  // [s] of this thread
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}
double wall_now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

double median(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  return v[v.size() / 2];
}

using Way = std::function<void(std::span<const LoopNumbers>, std::span<LoopPoints>)>;

void compare(const char* title, Method method, const Way& by_hand) {
  const auto numbers = draws();
  std::vector<LoopPoints> right(sets), got(sets);
  Lanes first = lanes_with(method), second = lanes_with(method);
  std::vector<double> hand, ours, ratios, speedups, speedups_by_hand;
  const std::span<const LoopNumbers> all(numbers);
  const auto on_one = [&](std::vector<double>& cpu, const Way& way, std::span<LoopPoints> results) {
    const double begin = cpu_now(), wall = wall_now();
    way(all, results);
    cpu.push_back(cpu_now() - begin);
    return wall_now() - wall;
  };
  const auto on_two = [&](const Way& here, const Way& there, std::span<LoopPoints> results) {
    const double wall = wall_now();
    std::thread other([&] { there(all.subspan(sets / 2), results.subspan(sets / 2)); });
    here(all.first(sets / 2), results.first(sets / 2));
    other.join();
    return wall_now() - wall;
  };
  const Way mine = [&](auto in, auto out) { in_lanes(first, in, out); };
  const Way others = [&](auto in, auto out) { in_lanes(second, in, out); };
  for (int i = 0; i < repetitions; ++i) {
    const double by_hand_alone = on_one(hand, by_hand, right), alone = on_one(ours, mine, got);
    ratios.push_back(ours.back() / hand.back());
    speedups_by_hand.push_back(by_hand_alone / on_two(by_hand, by_hand, right));
    speedups.push_back(alone / on_two(mine, others, got));
  }
  double worst = 0;
  for (std::size_t s = 0; s < sets; ++s)
    for (std::size_t k = 0; k < 3; ++k)
      if (std::isfinite(right[s].p[k])) worst = std::max(worst, std::fabs(right[s].p[k] - got[s].p[k]));
  const double steps = 4000.0 * sets;
  std::printf(
      "%-8s by hand %6.3f ns a step, lanes %6.3f ns a step: %.2f times (%.2f to %.2f); two threads %.2f x "
      "(by hand %.2f x); largest difference %.1e um\n",
      title, median(hand) / steps * 1e9, median(ours) / steps * 1e9, median(ratios),
      *std::min_element(ratios.begin(), ratios.end()), *std::max_element(ratios.begin(), ratios.end()),
      median(speedups), median(speedups_by_hand), worst);
}

}  // namespace
}  // namespace hysteron::benchmarks

int main() {
  using namespace hysteron::benchmarks;
  std::printf("%zu parameter sets, 4000 steps each, medians of %d in turn\n", sets, repetitions);
  compare("Euler", hysteron::Method::euler, euler_by_hand);
  compare("RK4", hysteron::Method::rk4, rk4_by_hand);
}
