// Decides how the engine calls a block: a table of pure functions over a View of plain numbers.
// Does not know how a block is written; block.h makes the table from a block's static functions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "engine/block/declaration.h"
#include "engine/block/dual.h"
#include "engine/diagram/series.h"

namespace hysteron {

struct Node;
struct InstanceUnits;

/// Past of one signal, committed at accepted points only (dead time). Cubic Hermite where rates are known.
struct History {
  std::vector<double> t, u, rate;  ///< rate NaN = unknown, then linear between points
  std::size_t first = 0;           ///< points before this one are no longer needed
  double before = 0;               ///< value before the first point (the signal was at rest there)
};

/// What a block function sees: its own numbers and nothing else. All in SI.
/// T is double for values, Dual for a value together with its rate in time, Jet for slopes along several directions,
/// JetDual for the slopes of a rate.
template <class T>
struct View {
  const T* p = nullptr;       ///< parameters, one behind the other (text parameters as index of the choice)
  const int* p_at = nullptr;  ///< parameter i occupies p[p_at[i]] .. p[p_at[i + 1] - 1]
  const double* c = nullptr;  ///< constants that prepare() derived from the parameters
  int n_c = 0;
  const T* x = nullptr;  ///< states
  int n_x = 0;
  const T* m = nullptr;  ///< memory: committed in advance(), advanced in output()
  int n_m = 0;
  const T* u = nullptr;   ///< inputs
  const T* du = nullptr;  ///< rates of the inputs (only for functions that want them)
  int n_u = 0;
  int n_y = 0;                         ///< number of outputs
  T t{};                               ///< time [s]
  double branch = 0;                   ///< time that decides which smooth piece of a source applies [s]
  int mode = 0;                        ///< of a block with modes: the present one (reset: the one that begins)
  int mode_before = 0;                 ///< reset: the mode that ends
  const signed char* sides = nullptr;  ///< derivative: on which side of each of its kinks an integrator steps (-1, 1);
                                       ///< null: wherever the numbers are. Both must agree where they meet
  long hit = 0;                        ///< of a sampled block: number of the sampling instant, 0 at the offset
  std::uint64_t key = 0;               ///< made of the block's path: random numbers of its own
  const T* y = nullptr;                ///< update: the outputs of this instant, where the caller has them
  const Series* series = nullptr;
  const History* history = nullptr;
  T* out = nullptr;  ///< what the function writes: outputs, derivatives, memory, states at rest, constants

  const T& parameter(int i) const { return p[p_at[i]]; }
  std::span<const T> list(int i) const { return {p + p_at[i], static_cast<std::size_t>(p_at[i + 1] - p_at[i])}; }
  int choice(int i) const { return static_cast<int>(value_of(p[p_at[i]])); }
  std::span<const T> inputs() const { return {u, static_cast<std::size_t>(n_u)}; }
  std::span<const T> states() const { return {x, static_cast<std::size_t>(n_x)}; }
  std::span<const T> memory() const { return {m, static_cast<std::size_t>(n_m)}; }
};

/// What fixes the counts of a block: lengths of lists, choices of texts, number of wires; never a parameter's value.
struct Shape {
  const Declaration* declaration = nullptr;
  std::vector<int> list_lengths;                 ///< per declared parameter (1 for a number)
  std::vector<int> text_choices;                 ///< per declared parameter (0 for no text)
  int inputs = 0;                                ///< wires
  std::vector<int> columns{};                    ///< per declared parameter: columns of a matrix, else 0
  std::vector<std::vector<double>> structure{};  ///< per declared parameter: structural numbers, characters of texts
  std::vector<int> input_lengths{};              ///< per wire (blocks with vector ports)
  int length(const std::string& parameter) const;
  const std::string& text(const std::string& parameter) const;
  int rows_of(const std::string& matrix) const;
  int columns_of(const std::string& matrix) const;
  std::vector<int> whole_numbers(const std::string& structural) const;
  std::string free_text(const std::string& parameter) const;
};

struct Sizes {
  int states = 0, memory = 0, constants = 0, outputs = 1;
  int sampled_states = 0;                      ///< of a sampled block: numbers that change at its instants only
  bool feedthrough = true;                     ///< outputs depend on inputs at the same instant
  Smoothness smoothness = Smoothness::smooth;  ///< of a source's own signal
  bool history = false;                        ///< remembers the past of its input (dead time)
  int kinks = 0;                               ///< numbers that Kernel::kinks writes
  bool keeps_sides = false;                    ///< its derivative asks for View::sides
  std::vector<double> code{};  ///< the first of the constants, where the shape alone fixes them: a law that a text
                               ///< says, compiled. prepare() leaves them alone
  std::string error{};         ///< not empty: these shapes do not go together; says what and what instead

  // Blocks with vector ports only. `outputs` then counts all elements of all output ports.
  std::vector<int> input_lengths{};   ///< per wire: the length that it must have (0 = any)
  std::vector<int> shortest{};        ///< per wire: the length that it must have at least (empty = any)
  std::vector<int> output_lengths{};  ///< per output port
  std::string lengths_from{};         ///< what fixed them: "its matrix has 2 rows and 3 columns"
  std::vector<int> route{};           ///< not empty: a mere rewiring; which input element each output element hands on
  std::vector<UnitExpression> input_units{}, output_units{};  ///< per element, in place of the declared units
};

/// The functions of a block for one scalar T. A null pointer means that the block has no such function.
template <class T>
struct Functions {
  using Call = void (*)(const View<T>&);
  using RateCall = void (*)(const View<DualOf<T>>&);

  Call output = nullptr;           ///< out: outputs
  RateCall output_rate = nullptr;  ///< the same with rates
  Call derivative = nullptr;       ///< out: dx/dt
  Call advance = nullptr;          ///< out: what the memory becomes if the inputs are accepted; pure
  RateCall advance_rate = nullptr;
  Call update = nullptr;  ///< sampled blocks; x: sampled states, out: those after the instant
  Call guard = nullptr;   ///< blocks with modes; out: one number, positive while the mode may stay
  Call reset = nullptr;   ///< blocks with modes; out: states at the beginning of `mode`, which follows `mode_before`
};

/// [s] How long a jump takes that is followed (path.h): so short that what a law makes of its speed is that of an
/// infinite one. A power of two: what is homogeneous in the rate keeps its bits.
inline constexpr double jump_duration = 0x1p-30;

/// Many rows of one block, one behind the other, in runs side by side ("lanes") that differ in their numbers only: what
/// the exact advance asks for where the inputs of all rows are known. The number of row k in lane l stands at
/// [k * lanes + l]; row -1 is the point before the first one.
struct RowsView {
  /// What a block may be asked for: one lane, this many, or, if it is sized and has no states or memory, any number.
  static constexpr int most_lanes = 4;

  int lanes = 1;
  int count = 0;                        ///< rows
  const View<double>* views = nullptr;  ///< per lane: parameters, constants and counts; nothing else is set
  const double* const* u = nullptr;     ///< per input, from row -1 on
  double* const* y = nullptr;           ///< per output, from row 0 on
  double* x = nullptr;                  ///< states, lane by lane: at row -1, left as they are at the last row
  double* m = nullptr;                  ///< memory, the same; what no output can see (weight 0) may be left behind
  const double* h = nullptr;            ///< per row: the step that leads to it [s]; 0: there the inputs jump
  const double* t = nullptr;            ///< per row [s]; null for blocks that do not use the time
  int path_steps = 0;                   ///< Runge-Kutta steps along a jump; 0: states stand still there
  double* scratch = nullptr;            ///< of scratch_size()

  /// Numbers that one block needs beside its own.
  static std::size_t scratch_size(int inputs, int states, int memory, int outputs) {
    return static_cast<std::size_t>(4 * inputs + 5 * states + memory + outputs);
  }
};

/// One evaluation of one block in many runs side by side. Number i of lane l stands at [i * lanes + l], but for the
/// inputs, whose numbers stand at u[i][l]. In SI.
struct LanesView {
  int lanes = 0;                      ///< a multiple of eight
  const double* p = nullptr;          ///< parameters
  const double* x = nullptr;          ///< states
  const double* dx = nullptr;         ///< their rates (output_rate only)
  const double* m = nullptr;          ///< committed memory
  const double* const* u = nullptr;   ///< inputs
  const double* const* du = nullptr;  ///< their rates
  double t = 0, branch = 0;           ///< [s]
  double* out = nullptr;              ///< outputs, their rates, or dx/dt
  double* values = nullptr;           ///< output_rate of a source: its outputs; else null
  double* advanced = nullptr;         ///< output of a block with memory: what the memory becomes
};

/// A block in lanes: made by block.h from the functions of every block of fixed size that neither runs at instants nor
/// has modes. Null elsewhere: then a lane is evaluated behind the other.
struct LaneFunctions {
  using Call = void (*)(const LanesView&);
  Call output = nullptr, output_rate = nullptr, derivative = nullptr;
};

/// A block type: its declaration and its functions.
struct Kernel : Functions<double> {
  Declaration declaration;
  Functions<Jet> jet;  ///< the same with slopes
  LaneFunctions lanes;
  Sizes (*sizes)(const Shape&) = nullptr;
  bool derivative_wants_rate = false;
  bool guard_wants_rate = false;
  Call prepare = nullptr;         ///< out: constants from parameters
  Call rest = nullptr;            ///< out: states in equilibrium for constant inputs
  Call initial_states = nullptr;  ///< out: states at the start where nothing else is said (parameters only); of a
                                  ///< sampled block: its sampled states
  Call initial_memory = nullptr;  ///< out: memory before the first input (parameters only)
  Call given_memory = nullptr;    ///< out: memory from the numbers m that a diagram gives; absent: these themselves
  int (*initial_mode)(const View<double>&) = nullptr;        ///< mode to try first (parameters, states); absent: 0
  int (*next_mode)(const View<double>&) = nullptr;           ///< which mode follows `mode`, whose guard is not positive
  double (*next_breakpoint)(const View<double>&) = nullptr;  ///< first time behind t where the source is not smooth [s]
  double (*shortest_period)(const View<double>&) = nullptr;  ///< shortest period or corner distance of a source [s]
  double (*reach_back)(const View<double>&) = nullptr;       ///< how much past a history block needs [s]
  Call kinks = nullptr;  ///< out: Sizes::kinks numbers, each of which changes its sign where the law has a kink or a
                         ///< jump that is no change of mode (of parameters, states and inputs)
  bool (*is_linear_at)(const View<double>&) = nullptr;  ///< with these parameters outputs and rates are affine in
                                                        ///< (states, inputs); where Declaration::is_linear is not true.
                                                        ///< False where a parameter that decides is NaN
  bool (*is_affine_in_modes)(const View<double>&) = nullptr;  ///< the same in each of its modes
  void (*rows)(const RowsView&) = nullptr;                    ///< neither sampled nor a source: made by block.h
  bool uses_time = false;
  std::string (*check)(const View<double>&) =
      nullptr;  ///< "" or what is wrong with these parameter values, and the cure

  /// "" or why the numbers m that a diagram gives are no memory of this block, and the cure.
  std::string (*check_memory)(const View<double>&) = nullptr;

  /// Types whose ports and parameters depend on what a block was given (Declaration::names_from): the declaration of
  /// one block. Throws Error; its places begin at the block: "/y".
  Declaration (*instance)(const Declaration& type, const Node& block) = nullptr;
  /// What the units of some ports and parameters say of the others, where no unit expression could say it.
  void (*units)(const Shape&, InstanceUnits&) = nullptr;

  bool has_modes() const { return guard != nullptr; }
  bool is_sampled() const { return declaration.is_sampled; }
  template <class T>
  const Functions<T>& functions() const {
    if constexpr (std::is_same_v<T, double>)
      return *this;
    else
      return jet;
  }
};

using KernelPointer = std::shared_ptr<const Kernel>;

/// The block types that diagrams can name.
class Registry {
 public:
  /// Throws std::logic_error if the type is there already.
  void add(Kernel kernel);
  const Kernel* find(const std::string& type) const;  ///< nullptr if there is none
  std::vector<std::string> types() const;             ///< in the order of registration

 private:
  std::map<std::string, Kernel> kernels_;
  std::vector<std::string> order_;
};

}  // namespace hysteron
