#include "engine/events/path.h"

#include <algorithm>
#include <cmath>

#include "engine/diagram/index.h"
#include "engine/program/loops.h"

namespace hysteron {
namespace {

// Outputs that differ by less than this share of their size have not jumped: two formulas met at a corner.
constexpr double rounding = 1e-12;

/// Per block: can a jump of its outputs reach a block of `wanted` at once, on a way that satisfies `passes`.
std::vector<bool> reaches(const Program& program, const std::vector<bool>& wanted, const std::vector<bool>& passes) {
  std::vector<bool> result(program.blocks.size(), false);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t b = 0; b < program.blocks.size(); ++b) {
      if (!wanted[b] && !(passes[b] && result[b])) continue;
      for (const int s : program.blocks[b].source) {
        const auto from = at(program.signals[at(s)].block);
        if (!result[from]) result[from] = changed = true;
      }
    }
  }
  return result;
}

/// Per block: do its inputs reach its outputs between sampling instants.
std::vector<bool> feeds_through(const Program& program) {
  std::vector<bool> through;
  for (const auto& block : program.blocks) through.push_back(block.sizes.feedthrough && block.hit_index < 0);
  return through;
}

}  // namespace

std::vector<bool> turns_before_memory(const Program& program) {
  auto through = feeds_through(program);
  std::vector<bool> memory, bent;
  for (std::size_t b = 0; b < program.blocks.size(); ++b) {
    const auto& block = program.blocks[b];
    const bool law = block.kernel->declaration.is_rate_independent && block.sizes.states > 0;
    memory.push_back(block.sizes.memory > 0 || law);
    through[b] = through[b] || law;
  }
  const auto to_memory = reaches(program, memory, through);
  for (std::size_t b = 0; b < program.blocks.size(); ++b)
    bent.push_back(through[b] && !program.blocks[b].kernel->declaration.is_linear && to_memory[b]);
  return reaches(program, bent, through);
}

JumpPath::JumpPath(const Program& program, double relative_tolerance, std::span<const double> absolute_tolerance)
    : program_(program),
      relative_tolerance_(relative_tolerance),
      jumping_(program.blocks.size(), 0),
      rate_independent_(program.blocks.size(), 0),
      to_(program.signals.size()) {
  const auto n = program.blocks.size();
  std::vector<bool> laws(n);
  for (std::size_t b = 0; b < n; ++b) {
    const auto& block = program.blocks[b];
    const auto& declaration = block.kernel->declaration;
    laws[b] = declaration.is_rate_independent && block.sizes.states > 0;
    rate_independent_[b] = laws[b];
    if (!laws[b]) continue;
    for (int i = 0; i < block.sizes.states; ++i) {
      states_.push_back(block.x_begin + i);
      absolute_tolerance_.push_back(absolute_tolerance[at(block.x_begin + i)]);
    }
  }
  moves_ = reaches(program, laws, feeds_through(program));
  turns_ = turns_before_memory(program);
  point_.jumping = jumping_.data();
  point_.rate_independent = rate_independent_.data();
}

bool JumpPath::find_jumps(const Work& work, const std::vector<double>& before, std::span<const int> candidates) {
  bool any = false;
  std::fill(jumping_.begin(), jumping_.end(), static_cast<unsigned char>(0));
  for (const int b : candidates) {
    const auto& block = program_.blocks[at(b)];
    for (int i = block.y_begin; i < block.y_begin + block.sizes.outputs; ++i) {
      const double size = std::max(std::abs(before[at(i)]), std::abs(work.y[at(i)]));
      if (std::abs(work.y[at(i)] - before[at(i)]) > rounding * size) jumping_[at(b)] = 1;
    }
    any = any || jumping_[at(b)] != 0;
  }
  return any;
}

bool JumpPath::follow(Run& run, Work& work, double t, std::vector<double>& x, const std::vector<double>& before,
                      std::span<const int> candidates) {
  evaluate_values(program_, run, work, t, x.data());
  if (!find_jumps(work, before, candidates)) return false;
  bool moves = false, turns = false;
  for (std::size_t b = 0; b < jumping_.size(); ++b) {
    moves = moves || (jumping_[b] != 0 && moves_[b]);
    turns = turns || (jumping_[b] != 0 && turns_[b]);
  }
  if (!moves && !turns) return false;
  from_ = before;
  to_ = work.y;
  point_.from = from_.data();
  point_.to = to_.data();
  work.path = &point_;
  try {
    if (moves)
      integrate(run, work, t, x);
    else
      walk(run, work, t, x);
  } catch (...) {
    work.path = nullptr;
    throw;
  }
  work.path = nullptr;
  return moves;
}

void JumpPath::commit(Run& run, Work& work, double t, const std::vector<double>& x, double s) {
  point_.s = s;
  evaluate_values(program_, run, work, t, x.data());
  throw_if_unsolved(program_, work, t);
  commit_memory(program_, run, work);
}

void JumpPath::walk(Run& run, Work& work, double t, const std::vector<double>& x) {
  for (int i = 1; i < jump_pieces; ++i) commit(run, work, t, x, static_cast<double>(i) / jump_pieces);
  work.path = nullptr;  // its end is the value itself: from + (to - from) may be another in the last bit
  commit(run, work, t, x, 1);
}

void JumpPath::integrate(Run& run, Work& work, double t, std::vector<double>& x) {
  run_ = &run;
  work_ = &work;
  t_ = t;
  trial_ = x;
  if (solver_ == nullptr) {
    OdeSystem system;
    system.states = static_cast<int>(states_.size());
    system.derivative = [this](double s, const double* moving, double* rates) {
      point_.s = s;
      for (std::size_t i = 0; i < states_.size(); ++i) trial_[at(states_[i])] = moving[i];
      evaluate_derivatives(program_, *run_, *work_, t_, trial_.data());
      double sum = 0;  // of zeros: not zero if one of them is not finite
      for (std::size_t i = 0; i < states_.size(); ++i)
        sum += 0 * (rates[i] = jump_duration * work_->dx[at(states_[i])]);
      return sum == 0;
    };
    system.state_name = [this](int i) { return program_.state_names[at(states_[at(i)])]; };
    IntegratorOptions options;
    options.formula = Formula::runge_kutta;
    options.relative_tolerance = relative_tolerance_;
    options.max_step = program_.memory_blocks.empty() ? 0.25 : 1.0 / jump_pieces;
    solver_ = std::make_unique<Integrator>(std::move(system), options, absolute_tolerance_);
  }
  std::vector<double> start;
  for (const int i : states_) start.push_back(x[at(i)]);
  for (solver_->start(0, start); solver_->t() < 1;) {
    solver_->step(1);
    for (std::size_t i = 0; i < states_.size(); ++i) x[at(states_[i])] = solver_->x()[i];
    commit(run, work, t, x, std::min(solver_->t(), 1.0));
  }
}

}  // namespace hysteron
