// Decides how a checked graph is laid out as a program: places of numbers in the arenas of a run, names, parameters.
//
// The stages, each a function that reports all its problems before the next begins:
//   build_graph   choices, nested diagrams, names, types, values, wires
//   check_enabled what cannot be switched off and on
//   check_units   dimensions along the wires
//   order_steps   loops, rates, schedule
//   lay_out       offsets (here)
#include "engine/compile/compile.h"

#include <fmt/format.h>

#include <map>
#include <unordered_map>

#include "engine/compile/enabled.h"
#include "engine/compile/infinite.h"
#include "engine/compile/loop_wishes.h"
#include "engine/compile/order.h"
#include "engine/compile/unit_check.h"
#include "engine/diagram/value_text.h"
#include "engine/program/names.h"
#include "engine/program/past.h"

namespace hysteron {
namespace {

/// FNV-1a (Fowler, Noll, Vo; RFC 9923): spreads names over 64 bits, the same on every machine.
std::uint64_t key_of(const std::string& path) {
  std::uint64_t key = 0xcbf29ce484222325ULL;
  for (const char c : path) key = (key ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  return key;
}

/// Enters the block, which is added next, in the lists of the kinds that it is of.
void list_by_kind(const GraphBlock& g, BlockInstance& b, Program& program) {
  const int index = static_cast<int>(program.blocks.size());
  if (g.kernel->declaration.is_series) {
    b.series_index = static_cast<int>(program.series.size());
    program.series.push_back(g.series);
  }
  if (g.sizes.history) b.history_index = program.n_histories++;
  if (g.sizes.memory > 0) program.memory_blocks.push_back(index);
  if (g.kernel->is_sampled()) {
    b.hit_index = static_cast<int>(program.sampled_blocks.size());
    program.sampled_blocks.push_back(index);
  }
  if (g.kernel->has_modes()) {
    b.mode_index = static_cast<int>(program.modal_blocks.size());
    program.modal_blocks.push_back(index);
  }
  if (g.kernel->kinks != nullptr && g.sizes.kinks > 0) {
    program.kinked_blocks.push_back(index);
    if (g.sizes.keeps_sides) {
      b.sides_index = program.n_sides;
      program.n_sides += g.sizes.kinks;
    }
  }
  if (g.kernel->uses_time || g.kernel->declaration.is_series || g.sizes.history) program.time_blocks.push_back(index);
}

void name_states(const GraphBlock& g, Program& program) {
  const auto& states = g.kernel->declaration.states;
  for (int i = 0; i < g.sizes.states; ++i) {
    const auto k = static_cast<std::size_t>(i);
    program.state_names.push_back(static_cast<int>(states.size()) == g.sizes.states
                                      ? fmt::format("{}.{}", g.path, states[k].name)
                                      : fmt::format("{}.state[{}]", g.path, i));
    program.state_initial.push_back(k < states.size() ? states[k].initial_value : 0.0);
  }
}

/// Takes the shape, which nobody asks the graph for afterwards.
void lay_out_block(GraphBlock& g, Program& program) {
  BlockInstance b;
  b.path = g.path;
  b.key = key_of(g.path);
  b.origin = g.origin;
  b.kernel = g.kernel;
  b.sizes = g.sizes;
  b.shape = std::move(g.shape);
  b.p_begin = program.n_p;
  b.p_at.push_back(0);
  for (const auto& parameter : g.parameters) {
    for (const auto& number : parameter.numbers) program.p.push_back(number.si);
    b.p_at.push_back(b.p_at.back() + static_cast<int>(parameter.numbers.size()));
  }
  program.n_p += b.p_at.back();
  b.c_begin = program.n_c;
  program.n_c += g.sizes.constants;
  b.x_begin = program.n_x;
  program.n_x += g.sizes.states;
  b.m_begin = program.n_m;
  program.n_m += b.memory_count();
  b.enabling = g.enabling;
  if (b.enabling >= 0) {
    b.held_while_off = program.n_m;
    program.n_m += g.sizes.outputs;
  }
  b.u_begin = program.n_u;
  b.n_u = static_cast<int>(g.source.size());
  program.n_u += b.n_u;
  b.y_begin = g.first_signal;
  b.source = g.source;
  list_by_kind(g, b, program);
  b.adjacent = b.source.empty() ? -1 : b.source.front();
  for (std::size_t i = 1; i < b.source.size(); ++i)
    if (b.source[i] != b.source[i - 1] + 1) b.adjacent = -1;
  name_states(g, program);
  program.blocks.push_back(std::move(b));
}

/// Which blocks are inside of what, at any depth.
void list_enabled_blocks(Program& program) {
  for (std::size_t b = 0; b < program.blocks.size(); ++b)
    for (int e = program.blocks[b].enabling; e >= 0; e = program.enablings[static_cast<std::size_t>(e)].outer)
      program.enablings[static_cast<std::size_t>(e)].inside.push_back(static_cast<int>(b));
}

/// Dimension of a parameter whose unit was not written: as declared, or plain.
Unit unit_of(const ResolvedNumber& number, const ParameterDeclaration& p) {
  if (number.has_unit || p.unit.find('$') == std::string::npos) return number.unit;
  return Unit{};
}

/// "" of a number, "[2]" of a list, "[0][2]" of a matrix.
std::string index_of(const ResolvedParameter& parameter, std::size_t k) {
  const auto columns = static_cast<std::size_t>(parameter.columns);
  if (columns > 0) return fmt::format("[{}][{}]", k / columns, k % columns);
  return parameter.list ? fmt::format("[{}]", k) : "";
}

class ParameterTable {
 public:
  ParameterTable(const Graph& graph, Program& program) : graph_(graph), program_(program) {}

  void run() {
    for (std::size_t b = 0; b < graph_.blocks.size(); ++b) {
      const auto& declaration = graph_.blocks[b].kernel->declaration;
      for (std::size_t i = 0; i < declaration.parameters.size(); ++i)
        if (declaration.parameters[i].kind != ParameterKind::text && !declaration.parameters[i].is_structural)
          add(static_cast<int>(b), static_cast<int>(i));
    }
    apply_bounds();
    name_nested();
  }

 private:
  /// A number of a nested diagram has more names: "stage.k" as its block is written, and that of the parameter around
  /// it which the block was given.
  void name_nested() {
    const auto names = program_.parameter_names;
    std::map<std::string, std::string> stands_for;
    for (const auto& parameter : graph_.parameters) stands_for[parameter.path] = parameter.stands_for;
    for (const auto& parameter : graph_.parameters) {
      std::string number = parameter.path;
      // resolve.cpp has refused chains that lead back to themselves.
      for (auto next = stands_for.find(number); next != stands_for.end() && !next->second.empty();
           next = stands_for.find(number))
        number = next->second;
      for (auto at = names.lower_bound(number); at != names.end() && at->first.starts_with(number); ++at) {
        const std::string index = at->first.substr(number.size());
        if (!index.empty() && index.front() != '[') continue;
        program_.parameter_names.emplace(parameter.path + index, at->second);
        if (const auto slash = parameter.path.rfind('/'); slash != std::string::npos)
          program_.parameter_names.emplace(
              parameter.path.substr(0, slash) + "." + parameter.path.substr(slash + 1) + index, at->second);
      }
    }
  }

  void add(int b, int i) {
    const GraphBlock& block = graph_.blocks[static_cast<std::size_t>(b)];
    const BlockInstance& instance = program_.blocks[static_cast<std::size_t>(b)];
    const auto& p = block.kernel->declaration.parameters[static_cast<std::size_t>(i)];
    const auto& resolved = block.parameters[static_cast<std::size_t>(i)];
    for (std::size_t k = 0; k < resolved.numbers.size(); ++k) {
      const auto& number = resolved.numbers[k];
      const std::string index = index_of(resolved, k);
      const std::string own = block.owner + "." + p.name + index;
      const std::string path = number.parameter.empty() ? own : number.parameter + index;
      const int slot = instance.p_begin + instance.p_at[static_cast<std::size_t>(i)] + static_cast<int>(k);
      const auto found = program_.parameter_names.find(path);
      if (found != program_.parameter_names.end()) {
        ParameterInfo& info = program_.parameters[static_cast<std::size_t>(found->second)];
        info.slots.push_back(slot);
        info.linear = info.offset = false;  // in several places: products of itself are possible
        info.lower = std::max(info.lower, p.minimum);
        info.upper = std::min(info.upper, p.maximum);
        program_.parameter_names[own] = found->second;
        continue;
      }
      ParameterInfo info;
      info.path = path;
      info.slots = {slot};
      info.block = b;
      info.unit = unit_of(number, p);
      info.difference = p.is_difference;
      info.value = number.si;
      info.lower = p.minimum;
      info.upper = p.maximum;
      info.linear = p.is_linear;
      info.offset = p.is_offset;
      info.origin = number.origin;
      info.known_to = number.known_to;
      declared_.push_back(&p);
      program_.parameter_names[path] = program_.parameter_names[own] = static_cast<int>(program_.parameters.size());
      program_.parameters.push_back(std::move(info));
    }
  }

  /// As resolve() reads the unit of a value: a cycle is 2 pi rad where the block says rad.
  static Unit unit_as_read(const std::string& text, const ParameterInfo& info, const ParameterDeclaration& p) {
    Unit unit = parse_unit(text, info.path);
    if (p.unit.find('$') == std::string::npos)
      if (const double factor = dimension_factor(unit.dimension, parse_unit(p.unit).dimension); factor != 0)
        unit.scale *= factor;
    return unit;
  }

  /// The unit of a bound that was written without one: that of the value beside it, which need not be the value in use
  /// (--set or the diagram around this one may give another, in another unit).
  static Unit unit_of_bounds(const ParameterInfo& info, const DiagramParameter& given, const ParameterDeclaration& p) {
    const auto* number = std::get_if<Number>(&given.value.content);
    const bool set = was_set(given.value.origin);  // then the file wrote no unit: apply_settings() would have kept it
    if (number == nullptr && !set) return info.unit;
    if (number != nullptr && number->unit && !set) return unit_as_read(*number->unit, info, p);
    return p.unit.find('$') == std::string::npos ? parse_unit(p.unit) : Unit{};
  }

  static double in_si(const ParameterInfo& info, const DiagramParameter& given, const ParameterDeclaration& p,
                      const Number& bound) {
    const Unit unit = bound.unit ? unit_as_read(*bound.unit, info, p) : unit_of_bounds(info, given, p);
    if (bound.unit && dimension_factor(unit.dimension, info.unit.dimension) == 0)
      fail("wrong_unit", "/parameters/" + info.path + "/bounds",
           fmt::format("the bound of \"{}\" is in \"{}\", the value in \"{}\"", info.path, unit.text, info.unit.text),
           "write both in units of the same kind");
    return info.difference ? unit.difference_to_si(bound.value) : unit.to_si(bound.value);
  }

  static void apply_bounds(ParameterInfo& info, const DiagramParameter& given, const ParameterDeclaration& p) {
    info.free = given.free.value_or(false);
    if (given.lower) info.lower = std::max(info.lower, in_si(info, given, p, *given.lower));
    if (given.upper) info.upper = std::min(info.upper, in_si(info, given, p, *given.upper));
    if (!(info.lower <= info.value && info.value <= info.upper))
      fail("bad_value", "/parameters/" + info.path,
           fmt::format("\"{}\" is {}, outside its bounds {} ... {}", info.path,
                       value_text(info.value, info.unit, info.difference),
                       value_text(info.lower, info.unit, info.difference),
                       value_text(info.upper, info.unit, info.difference)),
           "move the value or the bounds");
  }

  void apply_bounds() {
    Problems problems;
    std::unordered_map<std::string, std::vector<std::size_t>> numbers;  // "gains" -> "gains[0]", "gains[1]" ...
    for (std::size_t i = 0; i < program_.parameters.size(); ++i)
      if (const std::string& path = program_.parameters[i].path; !graph_.parameters.empty())
        numbers[path.substr(0, path.find('['))].push_back(i);
    for (const auto& parameter : graph_.parameters) {
      const auto own = numbers.find(parameter.path);
      if (own == numbers.end()) continue;
      for (const std::size_t i : own->second) try {
          apply_bounds(program_.parameters[i], *parameter.given, *declared_[i]);
        } catch (const Error& e) {
          for (const auto& p : e.problems) problems.add(p.code, p.path, p.what, p.cure);
        }
    }
    problems.throw_if_any();
  }

  const Graph& graph_;
  Program& program_;
  std::vector<const ParameterDeclaration*> declared_{};  ///< of each of the program's parameters, at its first slot
};

}  // namespace

ProgramPointer compile(const Diagram& diagram, const Registry& registry) {
  return compile_graph(build_graph(diagram, registry), diagram);
}

ProgramPointer compile_graph(Graph graph, const Diagram& diagram) {
  check_enabled(graph);
  check_units(graph);
  auto program = std::make_shared<Program>();
  program->kernels = graph.kernels;
  program->signals = std::move(graph.signals);
  program->n_y = static_cast<int>(program->signals.size());
  program->blocks.reserve(graph.blocks.size());
  for (auto& block : graph.blocks) lay_out_block(block, *program);
  program->index_names();
  program->enablings = graph.enablings;
  list_enabled_blocks(*program);
  order_steps(graph, loop_wishes(diagram.simulate, *program), *program);
  ParameterTable(graph, *program).run();
  for (std::size_t i = 0; i < graph.inputs.size(); ++i) {
    program->input_names.push_back(graph.inputs[i].first);
    program->input_signals.push_back(graph.inputs[i].second);
    program->input_units.push_back(graph.input_units[i]);
  }
  for (const auto& [name, signal] : graph.open) {
    program->input_names.push_back(name);
    program->input_signals.push_back(signal);
    program->input_units.push_back(program->signals[static_cast<std::size_t>(signal)].unit);
  }
  for (const auto& [name, signal] : graph.outputs) {
    program->output_names.push_back(name);
    program->output_signals.push_back(signal);
  }
  program->index_names();  // with those of the outputs
  program->record_signals = graph.record;
  if (program->record_signals.empty()) program->record_signals = program->output_signals;
  if (program->record_signals.empty())
    for (int s = 0; s < program->n_y; ++s) program->record_signals.push_back(s);
  program->places = graph.places;
  program->simulate = diagram.simulate;
  program->title = diagram.title;
  program->pasts = pasts_of(diagram.simulate, *program);
  const Run begin = start(*program);  // where blocks refuse values that do not go together
  check_memories(*program, begin);
  check_infinite(*program, begin);
  return program;
}

}  // namespace hysteron
