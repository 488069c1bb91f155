#include "engine/past.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/units.h"

namespace hysteron {
namespace {

// Pieces of the way from one value to the next, each a step of the Runge-Kutta formula of order four: a law with a
// kink on the way is followed to 1e-7.
constexpr int pieces = 400;

bool remembers(const BlockInstance& b) {
  return b.n_u > 0 && (b.sizes.memory > 0 || (b.kernel->declaration.is_rate_independent && b.sizes.states > 0));
}

class Walker {
 public:
  Walker(const Program& program, Run& run, int block)
      : block_(program.blocks[static_cast<std::size_t>(block)]),
        run_(run),
        view_(view_of(program, run, block)),
        u_(static_cast<std::size_t>(block_.n_u)),
        rate_(u_),
        x_(static_cast<std::size_t>(block_.sizes.states)),
        memory_(static_cast<std::size_t>(block_.sizes.memory)) {
    view_.u = u_.data();
    view_.du = rate_.data();
  }

  void begin(double value) {
    u_[0] = value;
    remember();
  }
  void go(double from, double to) {
    rate_[0] = to - from;
    for (int i = 0; i < pieces && !x_.empty(); ++i) step(from, static_cast<double>(i) / pieces, 1.0 / pieces);
    u_[0] = to;
    remember();
  }

 private:
  void remember() {
    if (memory_.empty()) return;
    view_.m = run_.m.data() + block_.m_begin;
    view_.out = memory_.data();
    block_.kernel->advance(view_);
    std::copy(memory_.begin(), memory_.end(), run_.m.begin() + block_.m_begin);
  }
  std::vector<double> slope(double from, double s, const std::vector<double>& x) {
    std::vector<double> k(x.size());
    u_[0] = from + s * rate_[0];
    view_.x = x.data();
    view_.out = k.data();
    block_.kernel->derivative(view_);
    return k;
  }
  void step(double from, double s, double h) {
    double* state = run_.x.data() + block_.x_begin;
    const std::vector<double> x(state, state + block_.sizes.states);
    const auto moved = [&](const std::vector<double>& k, double by) {
      auto there = x;
      for (std::size_t i = 0; i < x.size(); ++i) there[i] += by * k[i];
      return there;
    };
    const auto a = slope(from, s, x), b = slope(from, s + h / 2, moved(a, h / 2)),
               c = slope(from, s + h / 2, moved(b, h / 2)), d = slope(from, s + h, moved(c, h));
    for (std::size_t i = 0; i < x.size(); ++i) state[i] += h / 6 * (a[i] + 2 * (b[i] + c[i]) + d[i]);
  }

  const BlockInstance& block_;
  Run& run_;
  View<double> view_;
  std::vector<double> u_, rate_, x_, memory_;
};

}  // namespace

std::vector<Past> pasts_of(const SimulateSettings& settings, const Program& program) {
  std::vector<Past> pasts;
  Problems problems;
  for (const auto& [path, numbers] : settings.past) {
    std::string place = "/simulate/past/";
    for (const char c : path) place += c == '/' ? "~1" : std::string(1, c);
    const int block = program.block_index(path);
    if (block < 0 || !remembers(program.blocks[static_cast<std::size_t>(block)])) {
      std::vector<std::string> names;
      for (const auto& b : program.blocks)
        if (remembers(b)) names.push_back(b.path);
      if (block < 0)
        problems.add("unknown_block", place, fmt::format("there is no block \"{}\"", path), did_you_mean(path, names));
      else
        problems.add("no_memory", place, fmt::format("\"{}\" remembers nothing of its input's way", path),
                     names.empty() ? "take the past out: no block of the diagram has one"
                                   : fmt::format("blocks that do: {}", fmt::join(names, ", ")));
      continue;
    }
    Past past{block, {}};
    const auto signal = static_cast<std::size_t>(program.blocks[static_cast<std::size_t>(block)].source.front());
    const Dimension& dimension = program.signals[signal].dimension;
    for (const auto& number : numbers) {
      const Unit unit = number.unit ? parse_unit(*number.unit, place) : Unit{};
      if (number.value != 0 && dimension_factor(unit.dimension, dimension) == 0)
        problems.add("wrong_unit", place,
                     fmt::format("{} {} is no value of the input of \"{}\", which is in {}", number.value, unit.text,
                                 path, to_text(dimension)),
                     "write the unit of that signal behind the number");
      past.inputs.push_back(number.unit ? unit.to_si(number.value) : number.value);
    }
    pasts.push_back(std::move(past));
  }
  problems.throw_if_any();
  return pasts;
}

void walk(const Program& program, Run& run, const Past& past) {
  if (past.inputs.empty()) return;
  Walker walker(program, run, past.block);
  walker.begin(past.inputs.front());
  for (std::size_t i = 1; i < past.inputs.size(); ++i) walker.go(past.inputs[i - 1], past.inputs[i]);
}

}  // namespace hysteron
