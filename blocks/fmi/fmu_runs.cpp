#include "blocks/fmi/fmu_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/diagram/error.h"

namespace hysteron::blocks {
namespace {

// So many runs go on side by side without a way that is gone twice; each instance may hold a whole model.
constexpr std::size_t most_instances = 16;
// Beyond so many, runs are forgotten, but never those that were used last. A node takes some 200 bytes and its numbers.
constexpr std::size_t most_nodes = 100'000;
// Number of a node: its tree times this, and its place in the tree. 2^53 is what a double counts to.
constexpr long places_of_tree = 1L << 28;

std::vector<unsigned> references_of(const std::vector<ForeignVariable>& list) {
  std::vector<unsigned> references;
  for (const auto& v : list) references.push_back(v.reference);
  return references;
}

/// Everything that was imported by this process.
struct Imported {
  std::mutex mutex;
  std::map<std::string, int> numbers;
  std::vector<std::unique_ptr<FmuRuns>> runs;
};

Imported& imported() {
  static Imported all;
  return all;
}

}  // namespace

int FmuRuns::number_of(const std::string& interface_text) {
  auto& all = imported();
  const std::lock_guard lock(all.mutex);
  const auto [place, is_new] = all.numbers.emplace(interface_text, static_cast<int>(all.runs.size()));
  if (is_new) all.runs.push_back(std::unique_ptr<FmuRuns>(new FmuRuns(foreign_interface(interface_text))));
  return place->second;
}

FmuRuns& FmuRuns::at_number(int number) {
  auto& all = imported();
  const std::lock_guard lock(all.mutex);
  return *all.runs.at(static_cast<std::size_t>(number));
}

FmuRuns::Tree& FmuRuns::tree_of(long node) {
  const auto found = trees_.find(node / places_of_tree);
  if (found == trees_.end())
    fail_numerics("fmu_forgotten", interface_.file,
                  "the state of the FMU is no more known: too many other runs were begun since this one",
                  "begin this run again from its start; the FMU goes the same way");
  found->second.used = ++uses_;
  return found->second;
}

FmuRuns::Node& FmuRuns::node(long number) {
  return tree_of(number).nodes.at(static_cast<std::size_t>(number % places_of_tree));
}

long FmuRuns::added(long tree, Node node) {
  auto& nodes = trees_.at(tree).nodes;
  nodes.push_back(std::move(node));
  ++nodes_;
  return tree * places_of_tree + static_cast<long>(nodes.size()) - 1;
}

/// Whoever is at work has used its tree a moment ago; so have the instances that are live.
void FmuRuns::forget() {
  while (nodes_ > most_nodes && trees_.size() > most_instances) {
    const auto oldest = std::min_element(trees_.begin(), trees_.end(),
                                         [](const auto& a, const auto& b) { return a.second.used < b.second.used; });
    std::erase_if(live_, [&](const auto& i) { return i.node / places_of_tree == oldest->first; });
    roots_.erase(oldest->second.root);
    nodes_ -= oldest->second.nodes.size();
    trees_.erase(oldest);
  }
}

FmuRuns::Instance FmuRuns::fresh(const Node& root) {
  if (interface_.binary.empty())
    fail("untrusted_fmu", interface_.file,
         fmt::format("{} is native code of somebody else, which is run only if you say that you trust it",
                     interface_.file),
         fmt::format("if you do: --allow {}", interface_.file));
  Instance made{std::make_unique<NativeFmu>(FmuPlace{interface_.version, interface_.binary, interface_.resources,
                                                     interface_.token, interface_.file}),
                0};
  const auto put = [&](const ForeignVariable& v, double value) { made.fmu->set({&v.reference, 1}, {&value, 1}); };
  for (const auto& [place, value] : root.parameters) put(interface_.parameters[static_cast<std::size_t>(place)], value);
  made.fmu->enter_initialization(root.from, {});
  made.fmu->exit_initialization();
  return made;
}

std::vector<double> FmuRuns::read(Instance& instance) {
  const auto references = references_of(interface_.outputs);
  std::vector<double> values(references.size());
  instance.fmu->get(references, values);
  return values;
}

void FmuRuns::keep(Instance instance) {
  live_.push_front(std::move(instance));
  if (live_.size() > most_instances) live_.pop_back();
}

long FmuRuns::root(double start, const std::vector<std::pair<int, double>>& parameters) {
  const std::lock_guard lock(mutex_);
  const auto known = roots_.find({start, parameters});
  if (known != roots_.end()) {
    tree_of(known->second);  // used now: who begins it again goes on from it, whatever other threads begin meanwhile
    return known->second;
  }
  forget();
  Node root;
  root.from = start;
  root.parameters = parameters;
  Instance instance = fresh(root);
  root.outputs = read(instance);
  const long tree = ++last_tree_;
  trees_[tree] = {{start, parameters}, {}, ++uses_};
  const long number = added(tree, std::move(root));
  roots_[{start, parameters}] = number;
  instance.node = number;
  keep(std::move(instance));
  return number;
}

void FmuRuns::step(Instance& instance, const Node& to) {
  instance.fmu->set(references_of(interface_.inputs), to.inputs);
  instance.fmu->step(to.from, to.size);
}

/// An instance that stands at the node, no more in the list of those that are live: what fails is thrown away.
FmuRuns::Instance FmuRuns::taken(long number) {
  const auto there = std::find_if(live_.begin(), live_.end(), [&](const auto& i) { return i.node == number; });
  if (there != live_.end()) {
    Instance instance = std::move(*there);
    live_.erase(there);
    return instance;
  }
  std::vector<long> way;
  for (long n = number; n != 0; n = node(n).parent) way.push_back(n);
  Instance instance = fresh(node(way.back()));
  for (std::size_t i = way.size() - 1; i-- > 0;) step(instance, node(way[i]));
  instance.node = number;
  return instance;
}

long FmuRuns::advanced(long from_node, std::span<const double> inputs, double from, double size) {
  const std::lock_guard lock(mutex_);
  for (const long child : node(from_node).children) {
    const Node& known = node(child);
    if (known.from == from && known.size == size && std::equal(inputs.begin(), inputs.end(), known.inputs.begin()))
      return child;
  }
  Node next;
  next.parent = from_node;
  next.from = from;
  next.size = size;
  next.inputs.assign(inputs.begin(), inputs.end());
  Instance instance = taken(from_node);
  step(instance, next);
  next.outputs = read(instance);
  const long number = added(from_node / places_of_tree, std::move(next));
  node(from_node).children.push_back(number);
  instance.node = number;
  keep(std::move(instance));
  return number;
}

std::vector<double> FmuRuns::outputs(long number) {
  const std::lock_guard lock(mutex_);
  return node(number).outputs;
}

}  // namespace hysteron::blocks
