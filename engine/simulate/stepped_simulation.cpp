#include "engine/simulate/stepped_simulation.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

#include "engine/diagram/index.h"
#include "engine/diagram/stop.h"
#include "engine/events/rest.h"
#include "engine/program/breakpoints.h"
#include "engine/program/loops.h"
#include "engine/simulate/adaptive_simulation.h"
#include "engine/simulate/choose_method.h"
#include "engine/simulate/step_tolerances.h"

namespace hysteron {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Series of one value, which is theirs at every time.
std::vector<std::shared_ptr<Series>> held_inputs(const Program& program) {
  std::vector<std::shared_ptr<Series>> inputs;
  for (std::size_t i = 0; i < program.input_names.size(); ++i)
    inputs.push_back(std::make_shared<Series>(Series{{0.0}, {0.0}, Between::hold}));
  return inputs;
}

void need_inputs_that_may_jump(const Program& program) {
  Problems problems;
  for (std::size_t i = 0; i < program.input_names.size(); ++i)
    if (!program.input_jump_reaches[i].empty())
      problems.add(
          "jump_into_rate", "/inputs/" + program.input_names[i],
          fmt::format("input \"{}\" is held from step to step, so it jumps into \"{}\", which is driven by the "
                      "rate of its input",
                      program.input_names[i], program.input_jump_reaches[i]),
          "put the amplifier's dynamics (a lag) between");
  problems.throw_if_any();
}

void bind_all(const Program& program, Run& run, const std::vector<std::shared_ptr<Series>>& inputs) {
  for (std::size_t i = 0; i < inputs.size(); ++i) bind_input(program, run, program.input_names[i], inputs[i]);
}

bool keeps_a_grid(Method method) { return method == Method::exact || method == Method::euler || method == Method::rk4; }

}  // namespace

SteppedSimulation::SteppedSimulation(ProgramPointer program, const SimulateOptions& options)
    : SteppedSimulation(program, options, hysteron::start(*program)) {}

SteppedSimulation::SteppedSimulation(ProgramPointer program, const SimulateOptions& options, Run start)
    : program_(std::move(program)),
      options_(held_tolerance(*program_, options)),
      start_(std::move(start)),
      inputs_(held_inputs(*program_)),
      wanted_(inputs_.size(), 0.0) {
  if (!(options_.until > options_.begin) || !std::isfinite(options_.until))
    fail("bad_value", "/simulate/until", fmt::format("{} s is no end of a run", options_.until),
         "give a time behind the start");
  need_inputs_that_may_jump(*program_);
  bind_all(*program_, start_, inputs_);
  if (keeps_a_grid(options_.method)) options_.method = Method::automatic;
  start_.t = options_.begin;
}

SteppedSimulation::SteppedSimulation(const SteppedSimulation& other)
    : program_(other.program_),
      options_(other.options_),
      start_(other.simulation_ != nullptr ? other.simulation_->at_present() : other.start_),
      inputs_(held_inputs(*program_)),
      wanted_(other.wanted_),
      failed_(other.failed_) {
  for (std::size_t i = 0; i < inputs_.size(); ++i) *inputs_[i] = *other.inputs_[i];
  bind_all(*program_, start_, inputs_);
  if (other.simulation_ != nullptr) simulation_ = std::make_unique<AdaptiveSimulation>(*other.simulation_, start_);
}

SteppedSimulation::~SteppedSimulation() = default;

double SteppedSimulation::t() const { return simulation_ != nullptr ? simulation_->t() : options_.begin; }

long SteppedSimulation::restarts() const { return simulation_ != nullptr ? simulation_->restarts() : 0; }

void SteppedSimulation::set(int input, double si) {
  if (input < 0 || at(input) >= inputs_.size())
    fail("bad_input", "set", fmt::format("there is no input {}: the diagram has {}", input, inputs_.size()),
         "count inputs from 0, in the order of the diagram");
  if (!std::isfinite(si))
    fail("bad_input", "/inputs/" + program_->input_names[at(input)], fmt::format("{} is no value of an input", si),
         "set a finite number");
  wanted_[at(input)] = si;
}

/// What fails leaves the run somewhere between two instants; what is stopped, where it may go on: work looks up before
/// anything of a step or of an instant has happened.
template <class Action>
auto SteppedSimulation::unless_failed(const Action& action) {
  if (failed_)
    fail_numerics("stepper_failed", "stepper", fmt::format("it failed before, at t = {:.9g} s", t()),
                  "begin a new one, or go on from a copy that was taken before");
  failed_ = true;
  try {
    if constexpr (std::is_void_v<decltype(action())>) {
      action();
      failed_ = false;
    } else {
      auto result = action();
      failed_ = false;
      return result;
    }
  } catch (const Stopped&) {
    failed_ = false;
    throw;
  }
}

void SteppedSimulation::begin() {
  if (simulation_ != nullptr) return;
  for (std::size_t i = 0; i < inputs_.size(); ++i) inputs_[i]->v.front() = wanted_[i];
  set_loop_accuracy(*program_, start_, options_.relative_tolerance, options_.absolute_tolerance);
  if (options_.at_rest) {  // which may be stopped halfway
    Run settled = start_;
    settle_at_rest(*program_, settled, options_.begin);
    start_ = std::move(settled);
  }
  if (options_.method == Method::automatic)
    options_.method = choose_method(*program_, start_, options_.begin, options_.until - options_.begin).method;
  simulation_ = std::make_unique<AdaptiveSimulation>(*program_, start_, options_, std::vector<double>{infinity},
                                                     std::vector<int>{});
  simulation_->begin();
}

void SteppedSimulation::apply_inputs() {
  bool changed = false;
  for (std::size_t i = 0; i < inputs_.size(); ++i) changed = changed || inputs_[i]->v.front() != wanted_[i];
  if (!changed) return;
  simulation_->jump_inputs([this] {
    for (std::size_t i = 0; i < inputs_.size(); ++i) inputs_[i]->v.front() = wanted_[i];
  });
}

void SteppedSimulation::advance(double until) {
  if (!(until >= t()) || !std::isfinite(until))
    fail("bad_input", "advance", fmt::format("{} s does not lie behind the present, {} s", until, t()),
         "advance to a later time");
  unless_failed([&] {
    begin();
    apply_inputs();
    simulation_->advance(until, inputs_.empty());
  });
}

double SteppedSimulation::value(int signal) {
  if (signal < 0 || at(signal) >= program_->signals.size())
    fail("bad_input", "value",
         fmt::format("there is no signal {}: the diagram has {}", signal, program_->signals.size()),
         "count signals from 0, in the order of the diagram");
  return unless_failed([&] {
    begin();
    return simulation_->value(signal);
  });
}

}  // namespace hysteron
