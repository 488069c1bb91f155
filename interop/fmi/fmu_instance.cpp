#include "interop/fmi/fmu_instance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "blocks/register_all.h"
#include "engine/diagram/error.h"
#include "engine/diagram/index.h"
#include "engine/diagram/unit_table.h"
#include "engine/program/parameter_values.h"
#include "io/diagram/packed_diagram.h"

namespace hysteron::interop {
namespace {

/// Relative: callers add up step sizes, and a million steps round to less.
constexpr double time_rounding = 1e-9;

/// For good: programs refer to it.
const Registry& registry() {
  static const Registry all = all_blocks();
  return all;
}

std::string content_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in || !text)
    fail("no_file", file, "the diagram of this FMU cannot be read",
         "hand over the folder \"resources\" of the unpacked FMU");
  return text.str();
}

ProgramPointer program_in(const std::string& resources, const std::string& token) {
  const std::string file = resources + (resources.ends_with('/') ? "" : "/") + "program.json";
  const std::string text = content_of(file);
  if (token != packed_token(text))
    fail("other_fmu", file,
         fmt::format("\"{}\" is the token of another FMU, this one has {}", token, packed_token(text)),
         "take binary, resources and model description from one file");
  const PackedDiagram packed = unpacked_diagram(text);
  learn_units(packed.units);
  return compile(packed.diagram, registry());
}

const char* name_of(FmuInstance::Phase phase) {
  switch (phase) {
    case FmuInstance::Phase::instantiated:
      return "before its initialization";
    case FmuInstance::Phase::initialization:
      return "in its initialization";
    case FmuInstance::Phase::stepping:
      return "between its steps";
    case FmuInstance::Phase::terminated:
      return "terminated";
    case FmuInstance::Phase::failed:
      return "failed";
  }
  return "";
}

}  // namespace

FmuInstance::State::State(const State& other)
    : phase(other.phase),
      parameters(other.parameters),
      inputs(other.inputs),
      begin(other.begin),
      stop(other.stop),
      tolerance(other.tolerance),
      stepper(other.stepper ? std::make_unique<SteppedSimulation>(*other.stepper) : nullptr) {}

FmuInstance::FmuInstance(const std::string& resources, const std::string& token)
    : program_(program_in(resources, token)), variables_(fmi_variables(*program_)), state_(fresh()) {}

FmuInstance::State FmuInstance::fresh() const {
  State state;
  for (const auto& unit : program_->input_units) state.inputs.push_back(unit.to_si(0));
  return state;
}

void FmuInstance::need_phase(std::initializer_list<Phase> allowed, const char* what) const {
  if (std::find(allowed.begin(), allowed.end(), state_.phase) != allowed.end()) return;
  const char* cure = state_.phase == Phase::failed || state_.phase == Phase::terminated
                         ? "reset it, or set a state that was saved before"
                         : "keep to the order: set up, enter and exit initialization, steps, terminate";
  fail("bad_call", what, fmt::format("the instance is {}, where this is not allowed", name_of(state_.phase)), cure);
}

void FmuInstance::set_up(std::optional<double> tolerance, double begin, std::optional<double> stop) {
  need_phase({Phase::instantiated}, "set up");
  if (!std::isfinite(begin)) fail("bad_call", "start time", fmt::format("{} is no time", begin), "give a finite one");
  if (stop && !(*stop > begin))
    fail("bad_call", "stop time", fmt::format("{} s does not lie behind the start, {} s", *stop, begin),
         "give a later stop time, or none");
  if (tolerance && !(*tolerance > 0 && *tolerance < 1))
    fail("bad_call", "tolerance", fmt::format("{} is no relative tolerance", *tolerance), "give e.g. 1e-6, or none");
  state_.tolerance = tolerance;
  state_.begin = begin;
  state_.stop = stop;
}

void FmuInstance::enter_initialization() {
  need_phase({Phase::instantiated}, "enter initialization");
  state_.phase = Phase::initialization;
}

void FmuInstance::exit_initialization() {
  need_phase({Phase::initialization}, "exit initialization");
  stepper();  // whose faults belong here
  state_.phase = Phase::stepping;
}

void FmuInstance::terminate() {
  need_phase({Phase::stepping, Phase::failed}, "terminate");
  state_.phase = Phase::terminated;
}

void FmuInstance::reset() { state_ = fresh(); }

const FmiVariable& FmuInstance::variable(unsigned reference) const {
  if (reference >= variables_.size())
    fail("bad_call", fmt::format("value reference {}", reference),
         fmt::format("there is no such variable: the last one is {}", variables_.size() - 1),
         "take value references from the model description of this FMU");
  return variables_[reference];
}

double FmuInstance::t() const { return state_.stepper ? state_.stepper->t() : state_.begin; }

double FmuInstance::get(unsigned reference) {
  const FmiVariable& v = variable(reference);
  switch (v.role) {
    case FmiRole::time:
      return t();
    case FmiRole::input:
      return v.from_si(state_.inputs[at(v.place)]);
    case FmiRole::parameter: {
      const auto set = state_.parameters.find(v.place);
      return v.from_si(set != state_.parameters.end() ? set->second : program_->parameters[at(v.place)].value);
    }
    case FmiRole::output:
    case FmiRole::local:
      break;
  }
  need_phase({Phase::initialization, Phase::stepping, Phase::terminated}, "get");
  return v.from_si(stepper().value(v.place));
}

void FmuInstance::set_parameter_value(const FmiVariable& v, double si) {
  need_phase({Phase::instantiated, Phase::initialization}, "set a parameter");
  // Refused here, where the caller knows which one it was; set once more when the run is made.
  Run run = start(*program_);
  const int place = v.place;
  set_parameters(*program_, run, {&place, 1}, {&si, 1}, RefusedValues::end_the_run);
  state_.parameters[place] = si;
  state_.stepper.reset();
}

void FmuInstance::set(unsigned reference, double value) {
  const FmiVariable& v = variable(reference);
  if (v.role != FmiRole::input && v.role != FmiRole::parameter)
    fail("bad_call", v.name, "it is computed and cannot be set", "set inputs and parameters");
  if (!std::isfinite(value)) fail("bad_call", v.name, fmt::format("{} is no value", value), "set a finite number");
  const double si = v.to_si(value);
  if (v.role == FmiRole::parameter) return set_parameter_value(v, si);
  need_phase({Phase::instantiated, Phase::initialization, Phase::stepping}, "set an input");
  state_.inputs[at(v.place)] = si;
  if (state_.phase != Phase::stepping)
    state_.stepper.reset();  // its value at the start
  else
    stepper().set(v.place, si);
}

SteppedSimulation& FmuInstance::stepper() {
  if (state_.stepper) return *state_.stepper;
  SimulateOptions options = simulate_options(*program_);
  const double usual = options.until - options.begin;
  options.begin = state_.begin;
  options.until = state_.stop.value_or(state_.begin + usual);
  if (state_.tolerance) options.relative_tolerance = *state_.tolerance;
  Run run = start(*program_);
  std::vector<int> places;
  std::vector<double> values;
  for (const auto& [place, si] : state_.parameters) places.push_back(place), values.push_back(si);
  set_parameters(*program_, run, places, values, RefusedValues::end_the_run);
  hysteron::reset(*program_, run);
  auto made = std::make_unique<SteppedSimulation>(program_, options, std::move(run));
  for (std::size_t i = 0; i < state_.inputs.size(); ++i) made->set(static_cast<int>(i), state_.inputs[i]);
  state_.stepper = std::move(made);
  return *state_.stepper;
}

void FmuInstance::step(double from, double size) {
  need_phase({Phase::stepping}, "step");
  const double close = time_rounding * std::max({std::abs(from), std::abs(t()), std::abs(size)});
  if (!(std::abs(from - t()) <= close))
    fail("bad_call", "step", fmt::format("it was to begin at {} s, and the instance is at {} s", from, t()),
         "begin each step where the last one ended, or set the state that was saved there");
  if (!(size > 0) || !std::isfinite(size))
    fail("bad_call", "step", fmt::format("{} s is no size of a step", size), "give a positive one");
  const double end = from + size;
  if (state_.stop && end > *state_.stop + time_rounding * std::max(std::abs(*state_.stop), size))
    fail("bad_call", "step", fmt::format("it would end at {} s, behind the stop time {} s", end, *state_.stop),
         "give a later stop time, or none");
  try {
    stepper().advance(end);
  } catch (...) {  // it stands somewhere between two instants
    state_.phase = Phase::failed;
    throw;
  }
}

}  // namespace hysteron::interop
