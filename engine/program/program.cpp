#include "engine/program/program.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "engine/program/loops.h"
#include "engine/program/names.h"
#include "engine/program/past.h"
#include "engine/program/refusal.h"
#include "engine/program/tolerances.h"

namespace hysteron {

bool Program::has_rate_loops() const {
  return std::any_of(loops.begin(), loops.end(), [](const Loop& loop) { return loop.needed && !loop.of_values(); });
}

bool Program::remembers() const { return n_m > 0 || n_histories > 0 || !loops.empty(); }

namespace {

/// The path of what stands at a place of a list (std::vector of blocks or of signals).
template <class List, class Text>
auto names_of(const List& list, Text text) {
  return [first = list.data(), text](std::size_t place) { return std::string_view(first[place].*text); };
}

auto output_at(const std::vector<std::string>& names) {
  return [&names](std::size_t place) { return std::string_view(names[place]); };
}

}  // namespace

void Program::index_names() {
  block_names.rebuild(blocks.size(), names_of(blocks, &BlockInstance::path));
  signal_names.rebuild(signals.size(), names_of(signals, &SignalInfo::path));
  port_names.rebuild(signals.size(), names_of(signals, &SignalInfo::port_path));
  outputs_by_name.rebuild(output_names.size(), output_at(output_names));
}

int Program::find_signal(const std::string& path) const {
  const auto by_path = signal_names.find(path, signals.size(), names_of(signals, &SignalInfo::path));
  if (by_path >= 0) return static_cast<int>(by_path);
  // "block.port" also where the block has one output, and the names of the diagram's outputs.
  const auto by_port = port_names.find(path, signals.size(), names_of(signals, &SignalInfo::port_path));
  if (by_port >= 0) return static_cast<int>(by_port);
  const auto output = outputs_by_name.find(path, output_names.size(), output_at(output_names));
  return output < 0 ? -1 : output_signals[static_cast<std::size_t>(output)];
}

int Program::signal(const std::string& path) const { return named_signal(*this, path); }

const ParameterInfo* Program::find_parameter(const std::string& path) const {
  const auto found = parameter_names.find(path);
  return found == parameter_names.end() ? nullptr : &parameters[static_cast<std::size_t>(found->second)];
}

int Program::block_index(const std::string& path) const {
  return static_cast<int>(block_names.find(path, blocks.size(), names_of(blocks, &BlockInstance::path)));
}

std::vector<bool> Program::downstream_of(int from, bool between_samples) const {
  std::vector<std::vector<int>> readers(blocks.size());
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (between_samples && blocks[b].kernel->is_sampled()) continue;
    for (const int s : blocks[b].source)
      readers[static_cast<std::size_t>(signals[static_cast<std::size_t>(s)].block)].push_back(static_cast<int>(b));
  }
  std::vector<bool> reached(blocks.size(), false);
  std::vector<int> todo{from};
  while (!todo.empty()) {
    const int b = todo.back();
    todo.pop_back();
    for (const int next : readers[static_cast<std::size_t>(b)])
      if (!reached[static_cast<std::size_t>(next)]) {
        reached[static_cast<std::size_t>(next)] = true;
        todo.push_back(next);
      }
  }
  return reached;
}

View<double> view_of(const Program& program, const Run& run, int block) {
  const BlockInstance& b = program.blocks[static_cast<std::size_t>(block)];
  View<double> v;
  v.p = run.p.data() + b.p_begin;
  v.p_at = b.p_at.data();
  v.c = run.c.data() + b.c_begin;
  v.n_c = b.sizes.constants;
  v.x = run.x.data() + b.x_begin;
  v.n_x = b.hit_index < 0 ? b.sizes.states : b.sizes.sampled_states;
  v.m = run.m.data() + b.m_begin;
  v.n_m = b.sizes.memory;
  v.n_u = b.n_u;
  v.n_y = b.sizes.outputs;
  v.key = b.key;
  v.mode = b.mode_index < 0 ? 0 : run.mode[static_cast<std::size_t>(b.mode_index)];
  v.t = run.t;
  v.branch = run.branch;
  v.series = b.series_index < 0 ? nullptr : run.series[static_cast<std::size_t>(b.series_index)].get();
  v.history = b.history_index < 0 ? nullptr : &run.histories[static_cast<std::size_t>(b.history_index)];
  return v;
}

void prepare(const Program& program, Run& run, int block) {
  const BlockInstance& b = program.blocks[static_cast<std::size_t>(block)];
  View<double> v = view_of(program, run, block);
  if (b.kernel->check)
    if (const std::string wrong = b.kernel->check(v); !wrong.empty())
      fail("bad_value", b.origin,
           fmt::format("{} \"{}\": {}", b.kernel->declaration.type, b.path, refusal_text(program, run, block, wrong)),
           "correct the parameter values");
  std::copy(b.sizes.code.begin(), b.sizes.code.end(), run.c.begin() + b.c_begin);
  if (b.kernel->prepare) {
    v.out = run.c.data() + b.c_begin;
    b.kernel->prepare(v);
  }
}

void prepare(const Program& program, Run& run) {
  Problems problems;
  for (std::size_t b = 0; b < program.blocks.size(); ++b) try {
      prepare(program, run, static_cast<int>(b));
    } catch (const Error& e) {
      for (const auto& p : e.problems) problems.add(p.code, p.path, p.what, p.cure);
    }
  problems.throw_if_any();
}

void reset(const Program& program, Run& run) {
  run.x = program.state_initial;
  run.warm = program.guess;
  std::fill(run.m.begin(), run.m.end(), 0.0);
  std::fill(run.direction.begin(), run.direction.end(), static_cast<signed char>(0));
  std::fill(run.hits.begin(), run.hits.end(), 0L);
  for (auto& h : run.histories) h = History{};
  for (std::size_t i = 0; i < program.blocks.size(); ++i) {
    const BlockInstance& b = program.blocks[i];
    View<double> v = view_of(program, run, static_cast<int>(i));
    if (b.kernel->initial_states && b.sizes.states > 0) {
      v.out = run.x.data() + b.x_begin;
      b.kernel->initial_states(v);
    }
    if (b.kernel->initial_states && b.sizes.sampled_states > 0) {
      v.out = run.m.data() + b.m_begin;
      b.kernel->initial_states(v);
    }
    if (b.mode_index >= 0)
      run.mode[static_cast<std::size_t>(b.mode_index)] = b.kernel->initial_mode ? b.kernel->initial_mode(v) : 0;
    if (b.kernel->initial_memory && b.sizes.memory > 0) {
      v.out = run.m.data() + b.m_begin;
      b.kernel->initial_memory(v);
    }
  }
  for (const Past& past : program.pasts) walk(program, run, past);
}

void begin_modes(const Program& program, Run& run) {
  for (const int block : program.modal_blocks) {
    const BlockInstance& b = program.blocks[static_cast<std::size_t>(block)];
    if (b.kernel->initial_mode != nullptr && b.sizes.states > 0)
      run.mode[static_cast<std::size_t>(b.mode_index)] = b.kernel->initial_mode(view_of(program, run, block));
  }
}

Run start(const Program& program) {
  Run run;
  run.p = program.p;
  run.c.assign(static_cast<std::size_t>(program.n_c), 0.0);
  run.m.assign(static_cast<std::size_t>(program.n_m), 0.0);
  run.x.assign(static_cast<std::size_t>(program.n_x), 0.0);
  run.direction.assign(program.memory_blocks.size(), 0);
  run.mode.assign(program.modal_blocks.size(), 0);
  run.hits.assign(program.sampled_blocks.size(), 0);
  run.series = program.series;
  run.histories.resize(static_cast<std::size_t>(program.n_histories));
  run.loop_absolute.assign(program.guess.size(), 0.0);
  prepare(program, run);
  reset(program, run);
  set_loop_accuracy(program, run, default_relative_tolerance, default_absolute_tolerance);
  return run;
}

void set_parameter(const Program& program, Run& run, const ParameterInfo& parameter, double si) {
  for (const int slot : parameter.slots) run.p[static_cast<std::size_t>(slot)] = si;
  for (const int slot : parameter.slots)
    for (std::size_t b = 0; b < program.blocks.size(); ++b) {
      const BlockInstance& block = program.blocks[b];
      if (slot >= block.p_begin && slot < block.p_begin + block.p_at.back()) prepare(program, run, static_cast<int>(b));
    }
}

void set_parameter(const Program& program, Run& run, const std::string& path, double si) {
  set_parameter(program, run, program.parameters[static_cast<std::size_t>(named_parameter(program, path))], si);
}

void bind_input(const Program& program, Run& run, const std::string& input, SeriesPointer series) {
  for (std::size_t i = 0; i < program.input_names.size(); ++i) {
    if (program.input_names[i] != input) continue;
    if (series && series->between == Between::hold && !program.input_jump_reaches[i].empty())
      fail("jump_into_rate", "/inputs/" + input,
           fmt::format("input \"{}\" is held between its samples, so it jumps into \"{}\", which is driven by the rate "
                       "of its input",
                       input, program.input_jump_reaches[i]),
           "let it move linearly (\"between_samples\": \"linear\"), or put the amplifier's dynamics (a lag) between");
    const int signal = program.input_signals[i];
    const int block = program.signals[static_cast<std::size_t>(signal)].block;
    run.series[static_cast<std::size_t>(program.blocks[static_cast<std::size_t>(block)].series_index)] =
        std::move(series);
    return;
  }
  fail("unknown_input", "/inputs/" + input, fmt::format("the diagram has no input \"{}\"", input),
       did_you_mean(input, program.input_names));
}

}  // namespace hysteron
