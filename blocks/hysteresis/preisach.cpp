#include "blocks/hysteresis/preisach.h"

#include <fmt/format.h>

#include <array>
#include <span>
#include <vector>

namespace hysteron::blocks {
namespace {

/// A kernel that has a weight, while rows pass.
struct Seen {
  std::size_t rising, falling;  // its cells
  double lower, upper;          // of the cell in which it switches up
  double slope;                 // its weight over that cell
  double reached;
  std::size_t place;
};

std::vector<Seen> seen_kernels(std::span<const double> level, std::span<const double> weights, const double* memory) {
  std::vector<Seen> list;
  for (std::size_t i = 0, k = 0; i + 1 < level.size(); ++i)
    for (std::size_t j = 0; j <= i; ++j, ++k)
      if (weights[k] != 0)
        list.push_back({i, j, level[i], level[i + 1], weights[k] / (level[i + 1] - level[i]), memory[k], k});
  return list;
}

}  // namespace

void Preisach::describe(Declaration& d) {
  d.name("preisach", "Preisach hysteresis with piecewise constant density and a linear part")
      .in_group("hysteresis")
      .elementwise()
      .at("core");
  d.law(
       "y = gain*u + sum weights[k] w_k; k of the cells i >= j: w_k = max(p_i, min(p_j, w_k before)); p_i = (u - "
       "levels[i])/(levels[i+1] - levels[i]) within 0 .. 1")
      .from(
          "Krasnosel'skii, Pokrovskii, Systems with Hysteresis (1989); Banks, Kurdila, Webb, Math. Probl. Eng. 3 "
          "(1997) 287-328; Preisach, Z. Phys. 94 (1935) 277-302");
  d.remark(
      "weights[k] belongs to the relays that switch up between levels i and i+1 and down between levels j and j+1, in "
      "the order (0, 0), (1, 0), (1, 1), (2, 0) ...: one for every pair of cells with j not above i, 55 for 11 "
      "levels.");
  d.remark(
      "The cells i = j have no loop of their own: they form a single-valued curve. Beyond the levels no "
      "relay switches.");
  d.remark(
      "The initial memory is the demagnetised state about \"before\": relays whose centre lies below it "
      "are up, as after an oscillation about it with decreasing amplitude.");
  d.remembers("u", "input level up to which the relays of each pair of cells are up");
  d.input("u", "$a", "drive");
  d.output("y", "$b", "displacement");
  d.list("levels", "$a", "limits of the cells along the input, increasing").increasing();
  d.list("weights", "$b", "output of each pair of cells when all its relays have switched").linear();
  d.parameter("gain", "$b/$a", "gain of the linear part").linear();
  d.parameter("before", "$a", "input value about which the relays were demagnetised before the start").optional("0");
}

Sizes Preisach::sizes(const Shape& shape) {
  Sizes s;
  const auto levels = static_cast<std::size_t>(shape.length("levels"));
  const auto weights = static_cast<std::size_t>(shape.length("weights"));
  s.memory = static_cast<int>(weights);
  if (levels < 2 || levels > preisach::most_cells + 1)
    s.error = fmt::format("{} \"levels\" enclose no cell; give 2 to {}", levels, preisach::most_cells + 1);
  else if (weights != preisach::kernels(levels))
    s.error = fmt::format("{} \"levels\" have {} pairs of cells, and there are {} \"weights\"; give one for each pair",
                          levels, preisach::kernels(levels), weights);
  return s;
}

void Preisach::initial_memory(const View<double>& v) {
  preisach::demagnetize(v.list(levels), v.parameter(before), v.out);
}

std::string Preisach::check_memory(const View<double>& v) {
  constexpr double slack = 1e-9;
  return preisach::can_stand(v.list(levels), v.memory(), slack)
             ? ""
             : "no input leads to this state of the relays: each value must lie within the cell in which the relays "
               "switch up, and relays of lower levels switch up first; take \"memory\" out, or give the memory at "
               "the end of a run";
}

void Preisach::rows_of(const RowsView& r, int lane) {
  const View<double>& v = r.views[lane];
  const auto level = v.list(levels);
  double* memory = r.m + lane * v.n_m;
  auto seen = seen_kernels(level, v.list(weights), memory);
  std::array<bool, preisach::most_cells> needed{};
  for (const auto& s : seen) needed[s.rising] = needed[s.falling] = true;
  std::vector<std::size_t> cells;
  for (std::size_t i = 0; i + 1 < level.size(); ++i)
    if (needed[i]) cells.push_back(i);
  std::array<double, preisach::most_cells> passed{};
  const double* u = r.u[0] + lane;
  double* y = r.y[0] + lane;
  for (std::ptrdiff_t row = 0; row < r.count; ++row) {
    const double now = u[row * r.lanes];
    for (const std::size_t i : cells) passed[i] = preisach::passed(level[i], level[i + 1], now);
    double sum = v.parameter(gain) * now;
    for (auto& s : seen) {
      s.reached = preisach::follow(s.lower, s.upper, passed[s.rising], passed[s.falling], s.reached);
      sum += s.slope * (s.reached - s.lower);
    }
    y[row * r.lanes] = sum;
  }
  for (const auto& s : seen) memory[s.place] = s.reached;
}

Kernel preisach_block() { return kernel<Preisach>(); }

}  // namespace hysteron::blocks
