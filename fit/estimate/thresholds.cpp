#include "fit/estimate/thresholds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/simulate/simulate.h"
#include "fit/signals/branches.h"

namespace hysteron {
namespace {

/// How far u is from where it last turned, row by row.
std::vector<double> swings(const std::vector<double>& u) {
  std::vector<double> list;
  const auto turns = turning_points(u, turning_threshold(u));
  double from = u.empty() ? 0 : u.front();
  std::size_t next = 0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    list.push_back(std::abs(u[i] - from));
    if (next < turns.size() && turns[next] == i) {
      from = u[i];
      ++next;
    }
  }
  return list;
}

Node& block_of(Diagram& diagram, const std::string& name) {
  Node* node = diagram.blocks.find(name);
  if (node != nullptr && !node->from.empty()) node = node->from.find(node->choose);
  if (node == nullptr)
    fail("no_block", name, fmt::format("the diagram has no block \"{}\"", name),
         did_you_mean(name, diagram.blocks.names()));
  if (node->type != "prandtl_ishlinskii")
    fail("wrong_type", name,
         fmt::format("\"{}\" is a {}, and thresholds belong to a prandtl_ishlinskii", name, node->type),
         "name the block whose thresholds are to be placed");
  return *node;
}

/// The numbers of a list in the unit in which the diagram writes it.
NumberList written(const Program& program, const std::string& path, const std::vector<double>& si) {
  const auto& info = program.parameters[static_cast<std::size_t>(parameter_index(program, path))];
  const Unit unit = parameter_unit(program, info);
  NumberList list;
  for (const double x : si) {
    Number number{unit.difference_from_si(x), {}};
    if (!unit.text.empty()) number.unit = unit.text;
    list.push_back(std::move(number));
  }
  return list;
}

/// What the block reads along the train recordings [SI].
std::vector<std::vector<double>> inputs_of(const Program& program, const DataSet& data, const BlockInstance& block) {
  std::vector<std::vector<double>> inputs;
  for (const auto& recording : data.recordings) {
    if (recording.role != Role::train) continue;
    Run run = start(program);
    for (const auto& input : program.input_names) bind_input(program, run, input, input_series(data, recording, input));
    SimulateOptions o = simulate_options(program);
    o.instants = recording.t;
    o.begin = recording.t.front();
    o.until = recording.t.back();
    o.signals = {block.source.front()};
    o.at_rest = recording.at_rest;
    inputs.push_back(simulate(program, std::move(run), o).values.front());
  }
  return inputs;
}

/// Fits the weights (and, on wish, the thresholds behind the first) of the block; the operators as they are then.
Operators fitted(const Diagram& diagram, const Registry& registry, const std::shared_ptr<const DataSet>& data,
                 const std::string& block, bool with_thresholds, const FitOptions& options, FitResult& result,
                 Diagram& after) {
  const auto program = compile(diagram, registry);
  DataModel model(program, data);
  auto free = free_parameters(*program, {block + ".weights"});
  const auto element = [&](const char* list, std::size_t i) { return fmt::format("{}.{}[{}]", block, list, i); };
  std::size_t n = 0;
  while (program->find_parameter(element("thresholds", n)) != nullptr) ++n;
  for (auto& f : free)
    if (program->parameters[static_cast<std::size_t>(f.parameter)].path.rfind(block + ".weights[", 0) == 0) {
      f.lower = std::max(f.lower, 0.0);
      f.start = std::max(f.start, f.lower);
    }
  if (with_thresholds)
    for (std::size_t i = 1; i < n; ++i) {
      auto f = free_parameter(*program, element("thresholds", i));
      // Half way to the neighbours: thresholds must stay in order.
      const auto value = [&](std::size_t k) { return program->find_parameter(element("thresholds", k))->value; };
      f.lower = 0.5 * (value(i - 1) + value(i));
      f.upper = i + 1 < n ? 0.5 * (value(i) + value(i + 1)) : 1.5 * value(i) - 0.5 * value(i - 1);
      f.log_scale = false;
      free.push_back(f);
    }
  result = fit(model, noise_before_fit(model), free, options);
  Operators operators;
  if (!result.ok) return operators;
  after = with_parameters(diagram, *program, result.values);
  for (std::size_t i = 0; i < n; ++i) {
    const auto value = [&](const std::string& path) {
      for (const auto& e : result.estimates)
        if (e.path == path) return e.used;
      return program->find_parameter(path)->value;
    };
    operators.thresholds.push_back(value(element("thresholds", i)));
    operators.weights.push_back(value(element("weights", i)));
  }
  return operators;
}

}  // namespace

std::vector<double> place_thresholds(std::span<const std::vector<double>> inputs, int count, bool two_sided,
                                     Placement placement) {
  const double share = two_sided ? 0.5 : 1;
  std::vector<double> all;
  for (const auto& u : inputs) {
    const auto some = swings(u);
    all.insert(all.end(), some.begin(), some.end());
  }
  std::sort(all.begin(), all.end());
  std::vector<double> thresholds{0};
  const double reach = all.empty() ? 0 : all.back();
  // Equal within this, two thresholds are one.
  const double apart = 1e-6 * reach;
  for (int i = 1; i < count && reach > 0; ++i) {
    const double part = static_cast<double>(i) / count;
    const double swing = placement == Placement::even
                             ? part * reach
                             : all[static_cast<std::size_t>(part * static_cast<double>(all.size()))];
    if (share * swing > thresholds.back() + apart) thresholds.push_back(share * swing);
  }
  return thresholds;
}

Operators merge_operators(Operators many, int count) {
  Operators few;
  for (std::size_t i = 0; i < many.thresholds.size(); ++i) {
    if (i > 0 && !(many.weights[i] > 0)) continue;
    few.thresholds.push_back(many.thresholds[i]);
    few.weights.push_back(many.weights[i]);
  }
  while (few.thresholds.size() > static_cast<std::size_t>(std::max(2, count))) {
    std::size_t best = 1;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i + 1 < few.thresholds.size(); ++i) {
      const double a = few.weights[i], b = few.weights[i + 1];
      const double change = a * b / (a + b) * std::pow(few.thresholds[i + 1] - few.thresholds[i], 2);
      if (change < least) least = change, best = i;
    }
    const double a = few.weights[best], b = few.weights[best + 1];
    few.thresholds[best] = (a * few.thresholds[best] + b * few.thresholds[best + 1]) / (a + b);
    few.weights[best] = a + b;
    few.thresholds.erase(few.thresholds.begin() + static_cast<std::ptrdiff_t>(best) + 1);
    few.weights.erase(few.weights.begin() + static_cast<std::ptrdiff_t>(best) + 1);
  }
  return few;
}

ThresholdFit fit_thresholds(const Diagram& diagram, const Registry& registry,
                            const std::shared_ptr<const DataSet>& data, const std::string& block, int count,
                            Placement placement, const FitOptions& options) {
  if (count < 2 || count > 200)
    fail("bad_count", block, fmt::format("{} operators", count), "ask for 2 to 200 thresholds");
  ThresholdFit found;
  found.diagram = diagram;
  Node& node = block_of(found.diagram, block);
  const auto program = compile(diagram, registry);
  const auto& instance = program->blocks[static_cast<std::size_t>(program->block_index(block))];
  const Value* sides = node.parameters.find("sides");
  const bool two_sided = sides != nullptr && std::holds_alternative<std::string>(sides->content) &&
                         std::get<std::string>(sides->content) == "two";
  const auto put = [&](const Operators& operators) {
    node.parameters["thresholds"] = written(*program, block + ".thresholds[0]", operators.thresholds);
    node.parameters["weights"] = written(*program, block + ".weights[0]", operators.weights);
  };
  // The weight that is there already tells the size of one.
  double sum = 0;
  for (int i = 0; program->find_parameter(fmt::format("{}.weights[{}]", block, i)) != nullptr; ++i)
    sum += std::abs(program->find_parameter(fmt::format("{}.weights[{}]", block, i))->value);
  Operators many;
  many.thresholds = place_thresholds(inputs_of(*program, *data, instance), 4 * count, two_sided, placement);
  many.weights.assign(many.thresholds.size(), sum > 0 ? sum / static_cast<double>(many.thresholds.size()) : 1.0);
  put(many);
  FitOptions quick = options;
  quick.intervals = false;
  Diagram ignored;
  many = fitted(found.diagram, registry, data, block, false, quick, found.result, ignored);
  if (!found.result.ok) return found;
  put(merge_operators(std::move(many), count));
  Diagram after = found.diagram;
  // The error has kinks where an operator just moves in one more swing: some starts between the neighbours help over
  // them.
  FitOptions last = options;
  last.starts = std::max(options.starts, 10 * count);
  fitted(found.diagram, registry, data, block, true, last, found.result, after);
  if (found.result.ok) found.diagram = std::move(after);
  return found;
}

}  // namespace hysteron
