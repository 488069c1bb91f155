#include "io/fmi/fmi_variables.h"

#include <set>
#include <utility>

#include "engine/diagram/index.h"

namespace hysteron {
namespace {

/// Units that nobody wrote have no text, but a dimension.
Unit named(const Unit& unit) { return unit.text.empty() ? si_unit(unit.dimension) : unit; }

class List {
 public:
  void add(std::string name, FmiRole role, int place, const Unit& unit, bool difference = false) {
    while (!names_.insert(name).second) name += " (signal)";
    all_.push_back({std::move(name), role, place, unit, difference});
  }
  std::vector<FmiVariable> take() { return std::move(all_); }

 private:
  std::set<std::string> names_;
  std::vector<FmiVariable> all_;
};

/// The outputs, and what they show.
std::vector<std::pair<std::string, int>> shown(const Program& program) {
  std::vector<std::pair<std::string, int>> list;
  for (std::size_t i = 0; i < program.output_names.size(); ++i)
    list.emplace_back(program.output_names[i], program.output_signals[i]);
  if (list.empty())
    for (const int signal : program.record_signals) list.emplace_back(program.signals[at(signal)].path, signal);
  return list;
}

}  // namespace

std::vector<FmiVariable> fmi_variables(const Program& program) {
  List list;
  list.add("time", FmiRole::time, -1, parse_unit("s"));
  std::set<int> told;
  for (std::size_t i = 0; i < program.input_names.size(); ++i) {
    list.add(program.input_names[i], FmiRole::input, static_cast<int>(i), named(program.input_units[i]));
    told.insert(program.input_signals[i]);
  }
  for (const auto& [name, signal] : shown(program)) {
    list.add(name, FmiRole::output, signal, named(program.signals[at(signal)].unit));
    if (program.signals[at(signal)].path == name) told.insert(signal);
  }
  for (std::size_t i = 0; i < program.parameters.size(); ++i) {
    const auto& p = program.parameters[i];
    list.add(p.path, FmiRole::parameter, static_cast<int>(i), named(p.unit), p.difference);
  }
  for (std::size_t i = 0; i < program.signals.size(); ++i)
    if (!told.contains(static_cast<int>(i)))
      list.add(program.signals[i].path, FmiRole::local, static_cast<int>(i), named(program.signals[i].unit));
  return list.take();
}

}  // namespace hysteron
