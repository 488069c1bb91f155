#include "engine/program/past.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/diagram/units.h"
#include "engine/program/refusal.h"

namespace hysteron {
namespace {

// Pieces of the way from one value to the next, each a step of the Runge-Kutta formula of order four: a law with a
// kink on the way is followed to 1e-7.
constexpr int pieces = 400;

bool remembers(const BlockInstance& b) {
  return b.n_u > 0 && (b.sizes.memory > 0 || (b.kernel->declaration.is_rate_independent && b.sizes.states > 0));
}

bool remembers_numbers(const BlockInstance& b) { return !b.kernel->declaration.memory_port.empty(); }

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
    rate_[0] = (to - from) / jump_duration;
    for (int i = 0; i < pieces && !x_.empty(); ++i)
      step(from, to - from, static_cast<double>(i) / pieces, 1.0 / pieces);
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
  /// dx/ds at a place s of the way, 0 ... 1.
  std::vector<double> slope(double from, double way, double s, const std::vector<double>& x) {
    std::vector<double> k(x.size());
    u_[0] = from + s * way;
    view_.x = x.data();
    view_.out = k.data();
    block_.kernel->derivative(view_);
    for (double& rate : k) rate *= jump_duration;
    return k;
  }
  void step(double from, double way, double s, double h) {
    double* state = run_.x.data() + block_.x_begin;
    const std::vector<double> x(state, state + block_.sizes.states);
    const auto moved = [&](const std::vector<double>& k, double by) {
      auto there = x;
      for (std::size_t i = 0; i < x.size(); ++i) there[i] += by * k[i];
      return there;
    };
    const auto a = slope(from, way, s, x), b = slope(from, way, s + h / 2, moved(a, h / 2)),
               c = slope(from, way, s + h / 2, moved(b, h / 2)), d = slope(from, way, s + h, moved(c, h));
    for (std::size_t i = 0; i < x.size(); ++i) state[i] += h / 6 * (a[i] + 2 * (b[i] + c[i]) + d[i]);
  }

  const BlockInstance& block_;
  Run& run_;
  View<double> view_;
  std::vector<double> u_, rate_, x_, memory_;
};

/// "/simulate/memory/stage~1core"
std::string place_in(const std::string& section, const std::string& block) {
  std::string place = "/simulate/" + section + "/";
  for (const char c : block) place += c == '/' ? "~1" : std::string(1, c);
  return place;
}

/// Reads what a diagram says of pasts and memories; all problems together.
class Reader {
 public:
  explicit Reader(const Program& program) : program_(program) {}

  std::vector<Past> operator()(const SimulateSettings& settings) {
    for (const auto& [path, numbers] : settings.memory) read_memory(path, numbers);
    for (const auto& [path, numbers] : settings.past) read_past(path, numbers);
    problems_.throw_if_any();
    return std::move(pasts_);
  }

 private:
  const BlockInstance& block(int b) const { return program_.blocks[static_cast<std::size_t>(b)]; }

  /// -1, with a problem, where there is no such block or it does not remember.
  int find(const std::string& path, const std::string& place, bool (*fits)(const BlockInstance&),
           const std::string& what) {
    const int b = program_.block_index(path);
    if (b >= 0 && fits(block(b))) return b;
    std::vector<std::string> names;
    for (const auto& one : program_.blocks)
      if (fits(one)) names.push_back(one.path);
    if (b < 0)
      problems_.add("unknown_block", place, fmt::format("there is no block \"{}\"", path), did_you_mean(path, names));
    else
      problems_.add("no_memory", place, fmt::format("\"{}\" {}", path, what),
                    names.empty() ? "take it out: no block of the diagram does"
                                  : fmt::format("blocks that do: {}", fmt::join(names, ", ")));
    return -1;
  }

  std::vector<double> read(const NumberList& numbers, int signal, const std::string& place, const std::string& of) {
    const Dimension& dimension = program_.signals[static_cast<std::size_t>(signal)].dimension;
    std::vector<double> list;
    for (const auto& number : numbers) {
      const Unit unit = number.unit ? parse_unit(*number.unit, place) : Unit{};
      if (number.value != 0 && dimension_factor(unit.dimension, dimension) == 0)
        problems_.add(
            "wrong_unit", place,
            fmt::format("{} {} is no value of {}, which is in {}", number.value, unit.text, of, to_text(dimension)),
            "write the unit of that signal behind the number");
      list.push_back(number.unit ? unit.to_si(number.value) : number.value);
    }
    return list;
  }

  Past& past_of(int b) {
    for (auto& past : pasts_)
      if (past.block == b) return past;
    return pasts_.emplace_back(Past{b});
  }

  void read_past(const std::string& path, const NumberList& numbers) {
    const std::string place = place_in("past", path);
    const int b = find(path, place, remembers, "remembers nothing of its input's way");
    if (b < 0) return;
    past_of(b).inputs = read(numbers, block(b).source.front(), place, fmt::format("the input of \"{}\"", path));
  }

  /// The signal whose unit the memory has: of the declared port.
  static int memory_signal(const BlockInstance& b) {
    const auto& declaration = b.kernel->declaration;
    for (std::size_t i = 0; i < declaration.inputs.size(); ++i)
      if (declaration.inputs[i].name == declaration.memory_port) return b.source.at(i);
    return b.y_begin;
  }

  void read_memory(const std::string& path, const NumberList& numbers) {
    const std::string place = place_in("memory", path);
    const int b = find(path, place, remembers_numbers,
                       "has no memory that can be given (the states of a block have parameters of their own)");
    if (b < 0) return;
    const auto& declaration = block(b).kernel->declaration;
    if (static_cast<int>(numbers.size()) != block(b).sizes.memory) {
      problems_.add(
          "wrong_length", place,
          fmt::format("{} \"{}\" remembers {} number{}: {}; here are {}", declaration.type, path, block(b).sizes.memory,
                      block(b).sizes.memory == 1 ? "" : "s", declaration.memory_meaning, numbers.size()),
          "give one number for each");
      return;
    }
    past_of(b).memory = read(numbers, memory_signal(block(b)), place, fmt::format("the memory of \"{}\"", path));
  }

  const Program& program_;
  std::vector<Past> pasts_;
  Problems problems_;
};

}  // namespace

std::vector<Past> pasts_of(const SimulateSettings& settings, const Program& program) {
  return Reader(program)(settings);
}

void check_memories(const Program& program, const Run& run) {
  Problems problems;
  for (const Past& past : program.pasts) {
    const BlockInstance& b = program.blocks[static_cast<std::size_t>(past.block)];
    if (past.memory.empty() || b.kernel->check_memory == nullptr) continue;
    auto view = view_of(program, run, past.block);
    view.m = past.memory.data();
    if (const std::string wrong = b.kernel->check_memory(view); !wrong.empty())
      problems.add("bad_value", place_in("memory", b.path),
                   fmt::format("{} \"{}\": {}", b.kernel->declaration.type, b.path,
                               refusal_text(program, run, past.block, wrong)),
                   "give numbers that a past of the input can leave behind, or that past itself "
                   "(\"simulate\": {\"past\": ...})");
  }
  problems.throw_if_any();
}

void walk(const Program& program, Run& run, const Past& past) {
  const BlockInstance& b = program.blocks[static_cast<std::size_t>(past.block)];
  if (!past.memory.empty()) {
    double* memory = run.m.data() + b.m_begin;
    std::copy(past.memory.begin(), past.memory.end(), memory);
    if (b.kernel->given_memory != nullptr) {
      auto view = view_of(program, run, past.block);
      view.m = past.memory.data();
      view.out = memory;
      b.kernel->given_memory(view);
    }
  }
  if (past.inputs.empty()) return;
  Walker walker(program, run, past.block);
  walker.begin(past.inputs.front());
  for (std::size_t i = 1; i < past.inputs.size(); ++i) walker.go(past.inputs[i - 1], past.inputs[i]);
}

}  // namespace hysteron
