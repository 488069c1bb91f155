// Decides what a compiled diagram is (Program: immutable, shared) and what one simulation of it is (Run: one copyable
// value). Does not integrate: see simulate.h (CVODE) and advance.h (row by row, exactly). Evaluated: evaluate.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "engine/block/kernel.h"
#include "engine/diagram/diagram.h"
#include "engine/diagram/error.h"
#include "engine/diagram/units.h"

namespace hysteron {

/// One block of the flattened diagram with the places of its numbers in the arenas of a Run.
struct BlockInstance {
  std::string path;    ///< "stage/play"
  std::string origin;  ///< JSON pointer in its file
  const Kernel* kernel = nullptr;
  Sizes sizes{};
  Shape shape{};
  int p_begin = 0;
  std::vector<int> p_at{};  ///< offsets from p_begin, one more than declared parameters
  int c_begin = 0, x_begin = 0, m_begin = 0, u_begin = 0, y_begin = 0;
  int n_u = 0;
  std::vector<int> source{};  ///< per input: index of the signal that it reads
  int series_index = -1;      ///< into Run::series (recorded inputs and inputs of the diagram)
  int history_index = -1;     ///< into Run::histories
  int mode_index = -1;        ///< into Run::mode
  int sides_index = -1;       ///< into Run::sides
  int hit_index = -1;         ///< into Run::hits (sampled blocks)
  std::uint64_t key = 0;      ///< made of the path, the same in every program that has it
  int enabling = -1;          ///< into Program::enablings: the innermost that it is inside of; -1: it always runs
  int held_while_off = -1;    ///< in Run::m: its outputs while that is off
  int adjacent = -1;          ///< first of the signals that it reads where these stand side by side in Work::y, else -1

  /// Numbers in the memory arena: memory, or of a sampled block its sampled states and then its held outputs.
  int memory_count() const { return sizes.memory + sizes.sampled_states + (kernel->is_sampled() ? sizes.outputs : 0); }
  int held_begin() const { return m_begin + sizes.sampled_states; }
};

/// Its outputs are functions of time and parameters alone, whose rates cost no more than their values.
inline bool is_source_of_time(const BlockInstance& b) {
  return b.n_u == 0 && b.sizes.states == 0 && b.sizes.memory == 0 && !b.kernel->is_sampled() && !b.kernel->has_modes();
}

/// A signal: one output port of one block.
struct SignalInfo {
  std::string path;         ///< "stage.displacement", or "stage" where the block has one output
  std::string port_path{};  ///< the same with its port: "stage.y" also where the block has one output
  int block = -1;
  Dimension dimension{};
  Smoothness smoothness = Smoothness::smooth;
  Unit unit{};  ///< in which it is shown and written
};

/// One scalar number of a Program: its places in Run::p, and what is known of it.
struct ParameterInfo {
  std::string path;             ///< "kp" (of the diagram), "controller.kp", "core.weights[2]"
  std::vector<int> slots{};     ///< every place in Run::p that holds it (a diagram parameter may stand in several)
  int block = -1;               ///< block of the first slot
  Unit unit{};                  ///< as written, or as declared
  bool difference = false;      ///< converted without the unit's offset
  double value = 0;             ///< [SI]
  double lower = 0, upper = 0;  ///< [SI] bounds: from the diagram, else from the declaration (may be infinite)
  bool linear = false, offset = false;  ///< declared so at every slot
  bool free = false;
  std::string origin{};  ///< where the value was written
  /// One standard deviation of what is known of it, as a part of the value; 0 = exact; none: nobody says.
  std::optional<double> known_to{};
};

enum class Order { value, rate, derivative, loop };

struct Step {
  Order order = Order::value;
  int block = 0;  ///< of a loop: index into Program::loops
};

/// One number of an evaluation: Work::y (value of a signal), Work::rate (its rate) or Work::dx (derivative of a state).
struct Slot {
  Order order = Order::value;
  int index = 0;
};

/// Blocks that need each other at the same instant, solved together (loops.h). Either all of values, or of rates and
/// derivatives.
struct Loop {
  std::vector<Slot> tears;    ///< the numbers that are solved for
  std::vector<Step> steps;    ///< make the tears anew from the tears; blocks that are torn come last
  std::vector<Slot> outside;  ///< what the steps read and do not make
  std::vector<int> blocks;    ///< every block in it, once
  std::vector<Step> path;     ///< once around, from the first tear in the direction of the signals
  int warm_begin = 0;         ///< of the tears in Run::warm
  bool needed = true;         ///< false: of rates that memory merely wishes, to see reversals
  bool of_values() const { return tears.front().order == Order::value; }
};

/// What a block remembers at the start (past.h): its memory as given, then what its first input has been, value after
/// value [SI]. Either may be empty.
struct Past {
  int block = 0;
  std::vector<double> inputs{};
  std::vector<double> memory{};
};

/// The content of a nested diagram that runs only while, or only when, a signal says so. What is off holds its outputs,
/// states, modes and memory, and is not sampled.
struct Enabling {
  int block = 0;           ///< whose mode tells (runs_in_mode)
  int outer = -1;          ///< into Program::enablings: the one that it is inside of
  bool triggered = false;  ///< runs at edges only, for that instant
  bool resets_states = false, zeroes_outputs = false;
  std::string path{};         ///< of the nested diagram
  std::vector<int> inside{};  ///< all blocks, with those of enablings further in
};

/// Of the block that enables: a side of its level, plus this number while what it enables runs.
inline constexpr int enabled_mode = 3;
inline bool runs_in_mode(int mode) { return mode >= enabled_mode; }

struct Program {
  std::vector<BlockInstance> blocks;
  std::vector<Enabling> enablings;
  std::vector<KernelPointer> kernels;  ///< those that blocks have of their own (engine/block/instance.h)
  std::vector<SignalInfo> signals;
  NameIndex block_names{}, signal_names{}, port_names{}, outputs_by_name{};  ///< see index_names()
  std::vector<Step> all_values;                                              ///< every value
  std::vector<Step> derivative_steps;  ///< values, rates and derivatives that dx/dt needs
  std::vector<Step> rate_steps;        ///< what the rates of memory inputs need, behind derivative_steps
  std::vector<bool> has_rate;          ///< per signal: can its rate be computed
  int n_x = 0, n_p = 0, n_c = 0, n_m = 0, n_u = 0, n_y = 0;
  std::vector<double> p;  ///< values of the parameters as compiled [SI]
  std::vector<ParameterInfo> parameters;
  std::map<std::string, int> parameter_names;  ///< every name of a parameter ("kp" and "controller.kp") -> index
  std::vector<std::string> state_names;
  std::vector<double> state_initial;     ///< declared start [SI]
  std::vector<std::string> input_names;  ///< inputs of the diagram, in order = first entries of Run::series
  std::vector<Unit> input_units;
  std::vector<int> input_signals;  ///< their signals
  std::vector<std::string>
      input_jump_reaches;  ///< per input: rate-driven block that a jump (held samples) would reach, or ""
  std::vector<std::string> output_names;
  std::vector<int> output_signals;
  std::vector<int> record_signals;    ///< what `record` names
  std::vector<SeriesPointer> series;  ///< per Run::series: the compiled one (null for inputs of the diagram)
  int n_histories = 0;
  std::vector<int> memory_blocks;   ///< blocks that have memory, in program order
  std::vector<int> sampled_blocks;  ///< blocks that run at their instants only
  std::vector<int> modal_blocks;    ///< blocks with modes
  std::vector<int> kinked_blocks;   ///< blocks whose law has kinks or jumps without modes
  int n_sides = 0;                  ///< kinks of blocks that keep sides
  std::vector<int> time_blocks;     ///< blocks whose functions see time, a series or a history
  std::vector<Step> hit_values;     ///< every value in an order that is right at sampling instants too
  std::vector<int> value_order;     ///< every block, in the order of all_values with the loops written out
  std::vector<Loop> loops;
  std::vector<double> guess;  ///< [SI] per number of Run::warm: where the loops start from at first
  Ordered<std::vector<std::string>> places;
  std::vector<Past> pasts;
  SimulateSettings simulate;
  std::string title;

  bool has_rate_loops() const;                     ///< some rates need each other
  bool remembers() const;                          ///< accept() has something to keep
  int signal(const std::string& path) const;       ///< throws Error "unknown_signal" with the nearest name
  int find_signal(const std::string& path) const;  ///< -1 if there is none
  void index_names();                              ///< blocks, signals and outputs have their names: found by hash
  const ParameterInfo* find_parameter(const std::string& path) const;
  int block_index(const std::string& path) const;  ///< -1 if there is none
  /// Blocks whose outputs depend (through any path, states included) on block `from`, itself not counted unless in a
  /// loop. `between_samples`: while no sample is taken; nothing passes through what is sampled then.
  std::vector<bool> downstream_of(int from, bool between_samples = false) const;
};

using ProgramPointer = std::shared_ptr<const Program>;

/// Compiles a diagram: resolves parameters and choices, inlines nested diagrams, checks wires and units, orders the
/// steps. Throws Error with all problems of the first stage that fails.
ProgramPointer compile(const Diagram& diagram, const Registry& registry);
ProgramPointer compile(const Diagram& diagram, Registry&& registry) = delete;  ///< a program does not keep its blocks

/// All numbers of one simulation. Copy it to start another.
struct Run {
  double t = 0;
  double branch = 0;
  std::vector<double> x, p, c, m;
  std::vector<signed char> direction;  ///< per memory block: committed direction of its input (-1, 0, 1)
  std::vector<int> mode;               ///< per block with modes
  std::vector<signed char> sides;      ///< per kink of the blocks that keep sides (View::sides); empty: not kept
  std::vector<long> hits;              ///< per sampled block: sampling instants so far
  std::vector<double> warm;            ///< per tear of the loops: as solved at the last accepted point
  double loop_relative = 0;            ///< loops are solved until the error is below loop_relative * |tear| +
  std::vector<double> loop_absolute;   ///< loop_absolute, per tear; see set_loop_accuracy()
  std::vector<SeriesPointer> series;
  std::vector<History> histories;
  std::vector<int> varied{};  ///< places in p where runs of one task differ: what a value there makes linear
                              ///< (Kernel::is_linear_at) counts as nonlinear, so that they are computed alike
};

/// A run at its start: parameters as compiled, states as declared, memory virgin. Inputs of the diagram are still
/// unbound.
Run start(const Program& program);

/// Sets a parameter [SI] and what depends on it. Throws Error "unknown_parameter".
void set_parameter(const Program& program, Run& run, const std::string& path, double si);
void set_parameter(const Program& program, Run& run, const ParameterInfo& parameter, double si);
/// Recomputes the constants that blocks derive from their parameters (all blocks, or one). Throws Error if a block
/// refuses its values.
void prepare(const Program& program, Run& run);
void prepare(const Program& program, Run& run, int block);
/// States and memory as at the start (after parameters were changed).
void reset(const Program& program, Run& run);
/// The modes that go with the states of the run: for whoever put others there behind reset().
void begin_modes(const Program& program, Run& run);
void bind_input(const Program& program, Run& run, const std::string& input, SeriesPointer series);

/// A point of the path that a jump follows (path.h): the outputs of jumping blocks lie between, rates are those of a
/// ramp of jump_duration, and only rate-independent states move.
struct PathPoint {
  double s = 0;  ///< 0 ... 1
  const double* from = nullptr;
  const double* to = nullptr;                       ///< per signal, of jumping blocks only
  const unsigned char* jumping = nullptr;           ///< per block
  const unsigned char* rate_independent = nullptr;  ///< per block: its states move along the path
};

struct LoopSolver;

/// Scratch of an evaluation, one per thread. Reused, so that evaluation allocates nothing. T = double, or Jet for
/// slopes.
template <class T>
struct WorkOf {
  explicit WorkOf(const Program& program) : WorkOf(program, true) {}
  WorkOf(const Program& program, bool with_loops);
  ~WorkOf();
  WorkOf(WorkOf&&) noexcept;
  WorkOf& operator=(WorkOf&&) noexcept;

  std::vector<T> y;      ///< per signal: its value
  std::vector<T> rate;   ///< per signal: its rate [1/s], where it was asked for
  std::vector<T> dx;     ///< per state
  std::vector<T> m;      ///< trial memory
  std::vector<T> guard;  ///< per block with modes: positive while its mode may stay
  /// Only for T = Jet: the numbers of the run with their slopes. refresh() copies the values, slopes stay as they were
  /// set (zero at first).
  std::vector<T> p, m_committed;
  void refresh(const Run& run) requires(!std::is_same_v<T, double>);

  const PathPoint* path = nullptr;     ///< set while a jump is followed
  const unsigned char* due = nullptr;  ///< set at a sampling instant: per sampled block, does it run now
  /// The first loop that the last evaluation could not solve; -1 if there is none. What was to be computed is then NaN.
  int unsolved = -1;

  // Scratch of the steps; meaningless outside.
  /// What the steps need of a block, in one cache line: with all that a BlockInstance tells, a diagram of thousands of
  /// blocks would not fit into the caches.
  struct Call {
    typename Functions<T>::Call output = nullptr, derivative = nullptr;
    typename Functions<T>::RateCall output_rate = nullptr;  ///< null: output does, at rates in place of values
    const int* source = nullptr;                            ///< per input: the signal
    int inputs = 0;         ///< to be gathered before derivative: none where they stand side by side in y
    int output_inputs = 0;  ///< the same before output
    int u_begin = 0, x_begin = 0, y_begin = 0, p_begin = 0, parameters = 0;
    bool plain = false;        ///< output is a function of parameters, states, inputs and time: no memory, not sampled
    bool wants_rate = false;   ///< derivative does
    bool source_only = false;  ///< plain, of time and parameters alone
    bool timed = false;        ///< sees time, a series or a history
    int enabled_by = -1;       ///< the block whose mode says whether it runs; -1: it always does
  };
  std::vector<Call> calls;
  std::vector<int> lists;             // of all blocks, side by side: their sources, then their p_at
  std::unique_ptr<LoopSolver> loops;  // null if the program has none
  std::vector<T> u, du;
  std::vector<View<T>> views;
  std::vector<View<DualOf<T>>> rate_views;  // empty if no step computes rates
  std::vector<DualOf<T>> dual_u, dual_x, dual_m, dual_p, dual_out, dual_m_committed;
  std::array<const void*, 4> bound_to{};
};
using Work = WorkOf<double>;
using JetWork = WorkOf<Jet>;

// Evaluations are pure towards `run`. x: one number per state [SI].

/// Values of all signals at (t, x) with trial memory: work.y.
template <class T>
void evaluate_values(const Program& program, const Run& run, WorkOf<T>& work, double t, const T* x);
/// dx/dt, with the values and rates that it needs: work.dx.
template <class T>
void evaluate_derivatives(const Program& program, const Run& run, WorkOf<T>& work, double t, const T* x);
/// Rates of the inputs of memory blocks (work.rate), after evaluate_derivatives at the same point.
template <class T>
void evaluate_memory_rates(const Program& program, const Run& run, WorkOf<T>& work, double t, const T* x);
/// Guards of all blocks with modes: work.guard. Evaluates derivatives, rates and values first.
template <class T>
void evaluate_guards(const Program& program, const Run& run, WorkOf<T>& work, double t, const T* x);
/// Commits memory, histories and where loops start from at an accepted point: the only function that changes them, but
/// for what sampled blocks hold (events.h). Evaluates values first. Throws Error "loop_unsolved".
void accept(const Program& program, Run& run, Work& work, double t, const double* x);

/// Commits the trial memory of the last evaluation of values, and where its loops stand.
void commit_memory(const Program& program, Run& run, const Work& work);

/// Is the block inside of something that is switched off?
inline bool is_off(const Program& program, const Run& run, const BlockInstance& block) {
  if (block.enabling < 0) return false;
  const auto& enabling = program.enablings[static_cast<std::size_t>(block.enabling)];
  const auto& by = program.blocks[static_cast<std::size_t>(enabling.block)];
  return !runs_in_mode(run.mode[static_cast<std::size_t>(by.mode_index)]);
}

/// View of one block's committed numbers; inputs are gathered into `inputs`.
View<double> view_of(const Program& program, const Run& run, int block);

}  // namespace hysteron
