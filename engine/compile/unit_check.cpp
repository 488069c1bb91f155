// Decides the dimension of every signal: unit variables of each block are found from wires and from the units written
// at its parameters, until nothing changes; then every port is held against its wire. Checking only: nothing is
// rescaled.
#include "engine/compile/unit_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <queue>
#include <unordered_map>
#include <unordered_set>

#include "engine/block/instance.h"

namespace hysteron {
namespace {

/// "$b/$a*s" taken apart: a known dimension times powers of variables.
struct Expression {
  Dimension known{};
  std::map<std::string, int> variables{};
};

Expression parse_expression(const std::string& text) {
  Expression e;
  if (text.find('$') == std::string::npos) {
    e.known = parse_unit(text).dimension;
    return e;
  }
  int sign = 1;
  std::size_t i = 0;
  while (i < text.size()) {
    const auto end = text.find_first_of("*/", i);
    const std::string token = text.substr(i, end == std::string::npos ? end : end - i);
    if (token.front() == '$') {
      e.variables[token] += sign;
    } else if (token != "1") {
      const Dimension d = parse_unit(token).dimension;
      e.known = sign > 0 ? e.known * d : e.known / d;
    }
    if (end == std::string::npos) break;
    sign = text[end] == '*' ? 1 : -1;
    i = end + 1;
  }
  std::erase_if(e.variables, [](const auto& v) { return v.second == 0; });
  return e;
}

/// Nothing and without end are the same in every unit.
bool fits_any_unit(const ResolvedNumber& number) {
  return !number.has_unit && (number.si == 0 || std::isinf(number.si));
}

/// "$a[i]" with the place of the element put in: "$a[2]".
std::string of_element(std::string text, const char* index, int element) {
  for (auto at = text.find(index); at != std::string::npos; at = text.find(index))
    text.replace(at, std::char_traits<char>::length(index), fmt::format("[{}]", element));
  return text;
}

Dimension to_power(const Dimension& d, int n) {
  Dimension r;
  for (int i = 0; i < std::abs(n); ++i) r = n > 0 ? r * d : r / d;
  return r;
}

using Known = std::optional<Dimension>;

/// What says something of a unit: an input, a parameter (or one number of it) or an output of a block.
struct Witness {
  enum class Kind { input, parameter, output };
  Kind kind = Kind::input;
  std::size_t index = 0;   ///< of inputs and outputs: into the numbers of the block; of a parameter: as declared
  std::size_t number = 0;  ///< of a parameter with several
};

/// What is known of one unit variable of a block ("$a"), and what fixed it.
struct Variable {
  std::string name;
  Dimension dimension{};
  Witness fixed_by{};
};

class UnitCheck {
 public:
  explicit UnitCheck(Graph& graph) : graph_(graph), units_(graph.blocks.size()), signals_(graph.signals.size()) {
    for (std::size_t i = 0; i < graph.inputs.size(); ++i)
      signals_[static_cast<std::size_t>(graph.inputs[i].second)] = graph.input_units[i].dimension;
    for (const auto& block : graph.blocks)
      if (const auto s = static_cast<std::size_t>(block.first_signal); block.unit_known)
        signals_[s] = graph.signals[s].unit.dimension;
    for (std::size_t b = 0; b < graph.blocks.size(); ++b)
      for (const int source : graph.blocks[b].source) readers_.emplace_back(source, b);
    std::sort(readers_.begin(), readers_.end());
  }

  void run() {
    const auto blocks_that = [&](auto wanted) {
      std::vector<std::size_t> list;
      for (std::size_t b = 0; b < graph_.blocks.size(); ++b)
        if (wanted(b)) list.push_back(b);
      return list;
    };
    find_contested();
    // What was set on the command line stands against what the file says, not the other way round; and a block whose
    // own parameters contradict each other against what its wires say, or its neighbours would be blamed for it.
    settle(blocks_that([](std::size_t) { return true; }));
    believe_those_set_ = true;
    settle(blocks_that([&](std::size_t b) { return has_value_set(graph_.blocks[b]); }));
    believe_contested_ = true;
    settle(blocks_that([&](std::size_t b) { return contested_[b]; }));
    // What is known of inputs by the laws that read them comes last: a guess where nothing else says it.
    ask_for_inputs_ = true;
    settle(blocks_that([&](std::size_t b) { return graph_.blocks[b].kernel->units != nullptr; }));
    report();
    for (std::size_t s = 0; s < signals_.size(); ++s) graph_.signals[s].dimension = signals_[s].value_or(Dimension{});
    show_units();
  }

 private:
  using Queue = std::priority_queue<std::size_t, std::vector<std::size_t>, std::greater<>>;

  /// Looks at these blocks (ascending), and at every block around which something has become known: one after the
  /// other as the diagram has them, again and again, until nothing changes.
  void settle(const std::vector<std::size_t>& blocks) {
    waiting_.assign(graph_.blocks.size(), false);
    for (const std::size_t b : blocks) waiting_[b] = true;
    Queue now{{}, blocks};
    while (!now.empty()) {
      Queue later;
      while (!now.empty()) {
        const std::size_t b = now.top();
        now.pop();
        waiting_[b] = false;
        changed_.clear();
        visit(b);
        for (const std::size_t next : changed_) {
          if (waiting_[next]) continue;
          waiting_[next] = true;
          (next > b ? now : later).push(next);
        }
      }
      now = std::move(later);
    }
  }

  static bool has_value_set(const GraphBlock& block) {
    for (const auto& parameter : block.parameters)
      for (const auto& number : parameter.numbers)
        if (was_set(number.origin)) return true;
    return false;
  }

  /// A signal has become known: its block and its readers may learn from it.
  void found(std::size_t signal, const Dimension& dimension) {
    signals_[signal] = dimension;
    changed_.push_back(static_cast<std::size_t>(graph_.signals[signal].block));
    const int s = static_cast<int>(signal);
    for (auto r = std::lower_bound(readers_.begin(), readers_.end(), std::pair(s, std::size_t{0}));
         r != readers_.end() && r->first == s; ++r)
      changed_.push_back(r->second);
  }

  /// Blocks whose parameters do not agree among themselves on a unit.
  void find_contested() {
    contested_.assign(graph_.blocks.size(), false);
    for (std::size_t b = 0; b < graph_.blocks.size(); ++b) {
      const auto each_of_parameters = [&](auto visit) {
        each_parameter(
            b, [&](const Expression& e, const Known& actual, const Witness& by, int) { visit(e, *actual, by); });
      };
      do {
        changed_.clear();
        each_of_parameters([&](const Expression& e, const Dimension& d, const Witness& by) { learn(b, e, d, by); });
      } while (!changed_.empty());
      if (units_[b].empty()) continue;
      each_of_parameters([&](const Expression& e, const Dimension& d, const Witness&) {
        const Known expected = value(b, e);
        if (expected && dimension_factor(d, *expected) != 1) contested_[b] = true;
      });
      units_[b].clear();
    }
  }

  const Variable* find(std::size_t b, const std::string& name) const {
    for (const auto& variable : units_[b])
      if (variable.name == name) return &variable;
    return nullptr;
  }

  Known value(std::size_t b, const Expression& e) const {
    Dimension d = e.known;
    for (const auto& [name, power] : e.variables) {
      const Variable* found = find(b, name);
      if (found == nullptr) return {};
      d = d * to_power(found->dimension, power);
    }
    return d;
  }

  /// Uses that `e` is `actual` to find a variable that is still open.
  void learn(std::size_t b, const Expression& e, const Dimension& actual, const Witness& by) {
    const std::string* open = nullptr;
    int open_power = 0;
    Dimension rest = e.known;
    for (const auto& [name, power] : e.variables) {
      const Variable* found = find(b, name);
      if (found != nullptr) {
        rest = rest * to_power(found->dimension, power);
      } else if (open != nullptr || std::abs(power) != 1) {
        return;
      } else {
        open = &name;
        open_power = power;
      }
    }
    if (open == nullptr) return;
    units_[b].push_back({*open, open_power > 0 ? actual / rest : rest / actual, by});
    changed_.push_back(b);
  }

  /// Each text is taken apart once; those that speak of an element are not kept, for there are many.
  const Expression& expression(const std::string& text) {
    const auto [known, is_new] = expressions_.try_emplace(text);
    if (is_new) known->second = parse_expression(text);
    return known->second;
  }

  /// Calls `visit` with the block's own unit for this number of a port, or with the one declared for the port.
  template <class Visit>
  void at_port(const std::vector<UnitExpression>& own, const PortDeclaration& port, int element, int signal,
               const Witness& by, Visit& visit) {
    const Known actual = signals_[static_cast<std::size_t>(signal)];
    if (by.index < own.size())
      visit(parse_expression(own[by.index]), actual, by, signal);
    else if (element < 0)
      visit(expression(port.unit), actual, by, signal);
    else
      visit(parse_expression(of_element(port.unit, "[i]", element)), actual, by, signal);
  }

  template <class Visit>
  void each_parameter(std::size_t b, Visit visit) {
    const GraphBlock& block = graph_.blocks[b];
    const Declaration& d = block.kernel->declaration;
    for (std::size_t i = 0; i < d.parameters.size(); ++i) {
      if (d.parameters[i].unit.find('$') == std::string::npos || d.parameters[i].kind == ParameterKind::text) continue;
      const int columns = block.parameters[i].columns;
      for (std::size_t k = 0; k < block.parameters[i].numbers.size(); ++k) {
        const auto& number = block.parameters[i].numbers[k];
        if (fits_any_unit(number)) continue;
        if (was_set(number.origin) && !believe_those_set_) continue;
        const Known actual(number.dimension.value_or(Dimension{}));
        const Witness by{Witness::Kind::parameter, i, k};
        if (columns == 0)
          visit(expression(d.parameters[i].unit), actual, by, -1);
        else
          visit(parse_expression(of_element(of_element(d.parameters[i].unit, "[row]", static_cast<int>(k) / columns),
                                            "[column]", static_cast<int>(k) % columns)),
                actual, by, -1);
      }
    }
  }

  template <class Visit>
  void each_constraint(std::size_t b, Visit visit) {
    const GraphBlock& block = graph_.blocks[b];
    const Declaration& d = block.kernel->declaration;
    if (d.type == "input") return;
    for (std::size_t i = 0; i < block.source.size(); ++i)
      at_port(block.sizes.input_units, d.inputs[static_cast<std::size_t>(block.input[i].port)], block.input[i].element,
              block.source[i], {Witness::Kind::input, i}, visit);
    each_parameter(b, visit);
    for (std::size_t i = 0; i < block.output.size(); ++i)
      at_port(block.sizes.output_units, d.outputs[static_cast<std::size_t>(block.output[i].port)],
              block.output[i].element, block.first_signal + static_cast<int>(i), {Witness::Kind::output, i}, visit);
  }

  void visit(std::size_t b) {
    each_constraint(b, [&](const Expression& e, const Known& actual, const Witness& by, int signal) {
      if (signal < 0 && contested_[b] && !believe_contested_) return;
      if (actual)
        learn(b, e, *actual, by);
      else if (const Known v = value(b, e); v && signal >= 0)
        found(static_cast<std::size_t>(signal), *v);
    });
    if (graph_.blocks[b].kernel->units != nullptr) ask_law(b);
  }

  /// "input u (from drive)"
  std::string told(std::size_t b, const Witness& by) const {
    const GraphBlock& block = graph_.blocks[b];
    const Declaration& d = block.kernel->declaration;
    if (by.kind == Witness::Kind::input) {
      const auto& port = d.inputs[static_cast<std::size_t>(block.input[by.index].port)];
      return fmt::format("input {} (from {})", port.name,
                         graph_.signals[static_cast<std::size_t>(block.source[by.index])].path);
    }
    if (by.kind == Witness::Kind::output) {
      const auto [p, element] = block.output[by.index];
      const std::string& name = d.outputs[static_cast<std::size_t>(p)].name;
      return element < 0 ? fmt::format("output {}", name) : fmt::format("output {}[{}]", name, element);
    }
    const ResolvedNumber& number = block.parameters[by.index].numbers[by.number];
    return fmt::format("parameter {} ({})", d.parameters[by.index].name,
                       number.has_unit ? "in " + number.unit.text : "without a unit");
  }

  /// The place to tell of it.
  const std::string& place_of(const GraphBlock& block, const Witness& by) const {
    if (by.kind != Witness::Kind::parameter) return block.origin;
    const std::string& origin = block.parameters[by.index].numbers[by.number].origin;
    return was_set(origin) ? origin : block.origin;
  }

  /// What the law itself says of its units (Kernel::units).
  InstanceUnits known_of(std::size_t b) const {
    const GraphBlock& block = graph_.blocks[b];
    InstanceUnits units;
    units.name = [this](const Dimension& d) { return d.none() ? "a plain number" : written(d); };
    for (const int source : block.source) units.inputs.push_back(signals_[static_cast<std::size_t>(source)]);
    for (std::size_t i = 0; i < block.output.size(); ++i)
      units.outputs.push_back(signals_[static_cast<std::size_t>(block.first_signal) + i]);
    for (const auto& parameter : block.parameters) {
      Known known;
      for (const auto& number : parameter.numbers)
        if (!known && !fits_any_unit(number)) known = number.dimension.value_or(Dimension{});
      units.parameters.push_back(known);
    }
    return units;
  }

  void ask_law(std::size_t b) {
    const GraphBlock& block = graph_.blocks[b];
    InstanceUnits units = known_of(b);
    block.kernel->units(block.shape, units);
    if (!units.error.empty()) return;  // told by report()
    const auto take = [&](int signal, const Known& told) {
      if (told && !signals_[static_cast<std::size_t>(signal)]) found(static_cast<std::size_t>(signal), *told);
    };
    for (std::size_t i = 0; ask_for_inputs_ && i < block.source.size(); ++i) take(block.source[i], units.inputs[i]);
    for (std::size_t i = 0; i < block.output.size(); ++i)
      take(block.first_signal + static_cast<int>(i), units.outputs[i]);
  }

  void report_law(std::size_t b, Problems& problems) const {
    const GraphBlock& block = graph_.blocks[b];
    InstanceUnits units = known_of(b);
    block.kernel->units(block.shape, units);
    if (!units.error.empty())
      problems.add("wrong_unit", block.origin + "/" + units.parameter,
                   fmt::format("\"{}\": {}", block.path, units.error), units.cure);
  }

  void report() {
    Problems problems;
    for (std::size_t b = 0; b < graph_.blocks.size(); ++b) {
      if (graph_.blocks[b].kernel->units != nullptr) report_law(b, problems);
      each_constraint(b, [&](const Expression& e, const Known& actual, const Witness& by, int) {
        const Known expected = value(b, e);
        if (!expected || !actual || dimension_factor(*actual, *expected) == 1) return;
        std::string chain;
        for (const auto& [name, power] : e.variables)
          if (const Variable* v = find(b, name); v != nullptr)
            chain += fmt::format("; {} says {}", told(b, v->fixed_by), named(v->dimension));
        problems.add("wrong_unit", place_of(graph_.blocks[b], by),
                     fmt::format("\"{}\": {} is {}, expected {}{}", graph_.blocks[b].path, told(b, by), named(*actual),
                                 named(*expected), chain),
                     "give the value the expected unit, or put a gain between");
      });
    }
    problems.throw_if_any();
  }

  /// In a unit that the file writes, where it writes one of this kind.
  std::string named(const Dimension& d) const { return d.none() ? "a plain number" : "in " + written(d); }
  std::string written(const Dimension& d) const {
    for (const auto& block : graph_.blocks)
      for (const auto& parameter : block.parameters)
        for (const auto& number : parameter.numbers)
          if (number.has_unit && number.unit.dimension == d) return number.unit.text;
    return si_unit(d).text;
  }

  /// The words of a unit ("V", "um", "s" of "V/(um s)"), each noted if it is a unit of its own.
  template <class Note>
  static void note_words(const std::string& text, Note note) {
    for (std::size_t k = 0; k <= text.size();) {
      const auto end = std::min(text.find_first_of("/*() ^", k), text.size());
      if (end > k) try {
          note(parse_unit(text.substr(k, end - k)));
        } catch (const Error&) {  // "1", or an exponent
        }
      k = end + 1;
    }
  }

  // Signals are shown in the units that the file uses: the first unit of that dimension that it names.
  void show_units() {
    std::map<std::array<std::int8_t, 9>, Unit> shown;
    const auto note = [&](const Unit& unit) {
      // "K/%" has the dimension of a temperature, but nobody reads a temperature in it: only units of one word.
      const bool one_word = unit.text.find_first_of("/*() ") == std::string::npos;
      if (one_word && !unit.dimension.none()) shown.try_emplace(unit.dimension.power, unit);
    };
    const auto each_unit_written = [&](auto visit) {
      for (const auto& block : graph_.blocks)
        for (const auto& parameter : block.parameters)
          for (const auto& number : parameter.numbers)
            if (number.has_unit) visit(number.unit);
    };
    for (const auto& unit : graph_.input_units) note(unit);
    each_unit_written(note);
    for (const auto& block : graph_.blocks)
      for (const auto* units : {&block.sizes.input_units, &block.sizes.output_units})
        for (const auto& unit : *units)
          if (unit.find('$') == std::string::npos) note(parse_unit(unit));
    std::unordered_set<std::string> seen;
    each_unit_written([&](const Unit& unit) {  // "um/V" also shows lengths in um
      if (seen.insert(unit.text).second) note_words(unit.text, note);
    });
    for (auto& signal : graph_.signals) {
      if (!signal.unit.text.empty()) continue;
      const auto [unit, is_new] = shown.try_emplace(signal.dimension.power);
      if (is_new) unit->second = si_unit(signal.dimension);
      signal.unit = unit->second;
    }
  }

  Graph& graph_;
  std::vector<std::vector<Variable>> units_;  ///< per block
  std::vector<Known> signals_;
  std::vector<std::pair<int, std::size_t>> readers_;  ///< signal and block that reads it, sorted
  std::vector<bool> contested_, waiting_;
  std::vector<std::size_t> changed_;  ///< blocks that the last visit has told something new
  std::unordered_map<std::string, Expression> expressions_;
  bool believe_those_set_ = false, believe_contested_ = false, ask_for_inputs_ = false;
};

}  // namespace

void check_units(Graph& graph) { UnitCheck(graph).run(); }

}  // namespace hysteron
