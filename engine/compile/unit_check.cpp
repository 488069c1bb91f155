// Decides the dimension of every signal: unit variables of each block are found from wires and from the units written
// at its parameters, until nothing changes; then every port is held against its wire. Checking only: nothing is
// rescaled.
#include "engine/compile/unit_check.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "engine/block/instance.h"

namespace hysteron {
namespace {

/// "$b/$a*s" taken apart: a known dimension times powers of variables.
struct Expression {
  Dimension known;
  std::map<std::string, int> variables;
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

/// What is known of one block's unit variables, and what fixed each ("$a" -> "input u (from drive)").
struct BlockUnits {
  std::map<std::string, Dimension> variables;
  std::map<std::string, std::string> fixed_by;
};

class UnitCheck {
 public:
  explicit UnitCheck(Graph& graph) : graph_(graph), units_(graph.blocks.size()), signals_(graph.signals.size()) {
    for (std::size_t i = 0; i < graph.inputs.size(); ++i)
      signals_[static_cast<std::size_t>(graph.inputs[i].second)] = graph.input_units[i].dimension;
    for (const auto& block : graph.blocks)
      if (const auto s = static_cast<std::size_t>(block.first_signal); block.unit_known)
        signals_[s] = graph.signals[s].unit.dimension;
  }

  void run() {
    find_contested();
    // What was set on the command line stands against what the file says, not the other way round; and a block whose
    // own parameters contradict each other against what its wires say, or its neighbours would be blamed for it.
    for (const auto& [those_set, those_contested] : {std::pair{false, false}, {true, false}, {true, true}}) {
      believe_those_set_ = those_set;
      believe_contested_ = those_contested;
      settle();
    }
    // What is known of inputs by the laws that read them comes last: a guess where nothing else says it.
    ask_for_inputs_ = true;
    settle();
    report();
    for (std::size_t s = 0; s < signals_.size(); ++s) graph_.signals[s].dimension = signals_[s].value_or(Dimension{});
    show_units();
  }

 private:
  void settle() {
    do {
      changed_ = false;
      for (std::size_t b = 0; b < graph_.blocks.size(); ++b) visit(b);
    } while (changed_);
  }

  /// Blocks whose parameters do not agree among themselves on a unit.
  void find_contested() {
    contested_.assign(graph_.blocks.size(), false);
    for (std::size_t b = 0; b < graph_.blocks.size(); ++b) {
      const auto each_of_parameters = [&](auto visit) {
        each_constraint(b, [&](const std::string& unit, const Known& actual, const std::string& why, int signal,
                               const std::string&) {
          if (signal < 0 && actual) visit(parse_expression(unit), *actual, why);
        });
      };
      do {
        changed_ = false;
        each_of_parameters(
            [&](const Expression& e, const Dimension& d, const std::string& why) { learn(b, e, d, why); });
      } while (changed_);
      each_of_parameters([&](const Expression& e, const Dimension& d, const std::string&) {
        const Known expected = value(b, e);
        if (expected && dimension_factor(d, *expected) != 1) contested_[b] = true;
      });
      units_[b] = {};
    }
  }

  Known value(std::size_t b, const Expression& e) const {
    Dimension d = e.known;
    for (const auto& [name, power] : e.variables) {
      const auto found = units_[b].variables.find(name);
      if (found == units_[b].variables.end()) return {};
      d = d * to_power(found->second, power);
    }
    return d;
  }

  /// Uses that `e` is `actual` to find a variable that is still open.
  void learn(std::size_t b, const Expression& e, const Dimension& actual, const std::string& why) {
    std::string open;
    Dimension rest = e.known;
    for (const auto& [name, power] : e.variables) {
      const auto found = units_[b].variables.find(name);
      if (found != units_[b].variables.end()) {
        rest = rest * to_power(found->second, power);
      } else if (!open.empty() || std::abs(power) != 1) {
        return;
      } else {
        open = name;
      }
    }
    if (open.empty()) return;
    units_[b].variables[open] = e.variables.at(open) > 0 ? actual / rest : rest / actual;
    units_[b].fixed_by[open] = why;
    changed_ = true;
  }

  /// The block's own unit for this element, or the one declared for the port.
  static std::string unit_at(const std::vector<UnitExpression>& own, std::size_t i, const UnitExpression& declared,
                             int element) {
    if (i < own.size()) return own[i];
    return element < 0 ? declared : of_element(declared, "[i]", element);
  }

  template <class Visit>
  void each_constraint(std::size_t b, Visit visit) {
    const GraphBlock& block = graph_.blocks[b];
    const Declaration& d = block.kernel->declaration;
    if (d.type == "input") return;
    for (std::size_t i = 0; i < block.source.size(); ++i) {
      const auto [p, element] = block.input[i];
      const auto& port = d.inputs[static_cast<std::size_t>(p)];
      const auto s = static_cast<std::size_t>(block.source[i]);
      visit(unit_at(block.sizes.input_units, i, port.unit, element), signals_[s],
            fmt::format("input {} (from {})", port.name, graph_.signals[s].path), block.source[i], block.origin);
    }
    for (std::size_t i = 0; i < d.parameters.size(); ++i) {
      if (d.parameters[i].unit.find('$') == std::string::npos || d.parameters[i].kind == ParameterKind::text) continue;
      const int columns = block.parameters[i].columns;
      for (std::size_t k = 0; k < block.parameters[i].numbers.size(); ++k) {
        const auto& number = block.parameters[i].numbers[k];
        if (fits_any_unit(number)) continue;
        if (was_set(number.origin) && !believe_those_set_) continue;
        std::string unit = d.parameters[i].unit;
        if (columns > 0)
          unit = of_element(of_element(std::move(unit), "[row]", static_cast<int>(k) / columns), "[column]",
                            static_cast<int>(k) % columns);
        visit(unit, Known(number.dimension.value_or(Dimension{})),
              fmt::format("parameter {} ({})", d.parameters[i].name,
                          number.has_unit ? "in " + number.unit.text : "without a unit"),
              -1, was_set(number.origin) ? number.origin : block.origin);
      }
    }
    for (std::size_t i = 0; i < block.output.size(); ++i) {
      const auto [p, element] = block.output[i];
      const auto& port = d.outputs[static_cast<std::size_t>(p)];
      const int s = block.first_signal + static_cast<int>(i);
      visit(unit_at(block.sizes.output_units, i, port.unit, element), signals_[static_cast<std::size_t>(s)],
            element < 0 ? fmt::format("output {}", port.name) : fmt::format("output {}[{}]", port.name, element), s,
            block.origin);
    }
  }

  void visit(std::size_t b) {
    each_constraint(
        b, [&](const std::string& unit, const Known& actual, const std::string& why, int signal, const std::string&) {
          if (signal < 0 && contested_[b] && !believe_contested_) return;
          const Expression e = parse_expression(unit);
          if (actual) {
            learn(b, e, *actual, why);
          } else if (const Known v = value(b, e); v && signal >= 0) {
            signals_[static_cast<std::size_t>(signal)] = v;
            changed_ = true;
          }
        });
    if (graph_.blocks[b].kernel->units != nullptr) ask_law(b);
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
    const auto take = [&](int signal, const Known& found) {
      Known& own = signals_[static_cast<std::size_t>(signal)];
      if (own || !found) return;
      own = found;
      changed_ = true;
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
      each_constraint(
          b, [&](const std::string& unit, const Known& actual, const std::string& why, int, const std::string& where) {
            const Known expected = value(b, parse_expression(unit));
            if (!expected || !actual || dimension_factor(*actual, *expected) == 1) return;
            std::string chain;
            for (const auto& [name, power] : parse_expression(unit).variables)
              if (const auto f = units_[b].fixed_by.find(name); f != units_[b].fixed_by.end())
                chain += fmt::format("; {} says {}", f->second, named(units_[b].variables[name]));
            problems.add("wrong_unit", where,
                         fmt::format("\"{}\": {} is {}, expected {}{}", graph_.blocks[b].path, why, named(*actual),
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
    std::vector<Unit> written;
    const auto note = [&](const Unit& unit) {
      // "K/%" has the dimension of a temperature, but nobody reads a temperature in it: only units of one word.
      const bool one_word = unit.text.find_first_of("/*() ") == std::string::npos;
      if (one_word && !(unit.dimension.none() && unit.scale == 1)) written.push_back(unit);
    };
    for (const auto& unit : graph_.input_units) note(unit);
    for (const auto& block : graph_.blocks)
      for (const auto& parameter : block.parameters)
        for (const auto& number : parameter.numbers)
          if (number.has_unit) note(number.unit);
    for (const auto& block : graph_.blocks)
      for (const auto* units : {&block.sizes.input_units, &block.sizes.output_units})
        for (const auto& unit : *units)
          if (unit.find('$') == std::string::npos) note(parse_unit(unit));
    for (const auto& block : graph_.blocks)  // "um/V" also shows lengths in um
      for (const auto& parameter : block.parameters)
        for (const auto& number : parameter.numbers)
          if (number.has_unit) note_words(number.unit.text, note);
    for (auto& signal : graph_.signals) {
      if (!signal.unit.text.empty()) continue;
      signal.unit = si_unit(signal.dimension);
      for (const auto& unit : written)
        if (unit.dimension == signal.dimension && !unit.dimension.none()) {
          signal.unit = unit;
          break;
        }
    }
  }

  Graph& graph_;
  std::vector<BlockUnits> units_;
  std::vector<Known> signals_;
  std::vector<bool> contested_;
  bool changed_ = false, believe_those_set_ = false, believe_contested_ = false, ask_for_inputs_ = false;
};

}  // namespace

void check_units(Graph& graph) { UnitCheck(graph).run(); }

}  // namespace hysteron
