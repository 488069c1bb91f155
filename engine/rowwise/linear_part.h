// Decides how a group of linear blocks is one state-space system x' = A x + B w + a, y = C x + D w + c, and how it is
// advanced exactly over a step in which its inputs w move linearly (first-order hold, by cached matrix exponentials).
// Rows one by one and many at a time: linear_part_rows.cpp; lanes: linear_part_lanes.cpp. Internal to the exact
// advance.
#pragma once

#include <Eigen/Core>
#include <Eigen/QR>
#include <cstddef>
#include <span>
#include <vector>

#include "engine/program/program.h"

namespace hysteron {

struct BlockMatrices;

class LinearPart {
 public:
  /// `blocks` in value order; `outputs`: signals of these blocks that somebody outside reads.
  LinearPart(const Program& program, std::vector<int> blocks, std::vector<int> outputs);

  const std::vector<int>& input_signals() const { return inputs_; }
  const std::vector<int>& output_signals() const { return outputs_; }
  bool has_states() const { return n_ > 0; }

  /// Builds the matrices for the parameters of a run; keeps the exponentials where A and B have not changed. Throws
  /// Error(Fault::numerics) "loop_unsolved" if blocks without states feed each other with gain one.
  void bind(const Program& program, const Run& run);
  /// States as in the run, or in equilibrium for the present inputs (what has no equilibrium of its own stays); then
  /// writes the outputs to y.
  void start(const Program& program, const Run& run, std::vector<double>& y, bool at_rest);
  /// Advances the states by h [s] while the inputs go linearly to their values in y; then writes the outputs to y.
  /// rounding [s]: by how much h may be off, as the difference of two times; steps that differ by less are one.
  void step(double h, double rounding, std::vector<double>& y);
  /// Inputs jumped: same states, new outputs.
  void refresh(std::vector<double>& y);
  /// Advances through many rows whose inputs are known. `kind`, per row: its step is lengths[kind] / substeps [s]; -1:
  /// the inputs jump, the states stand still. Values of row k at [k * stride]; row -1 of the inputs is the point
  /// before. States that no output can see are left where they are.
  struct RowsOfPart {
    int count = 0;
    std::ptrdiff_t stride = 1;
    const double* const* w = nullptr;  ///< per input
    double* const* y = nullptr;        ///< per output
    const int* kind = nullptr;
    const std::vector<double>* lengths = nullptr;
    int substeps = 1;
  };
  void pass(const RowsOfPart& rows);
  /// The same of one part in several runs at once, `rows` being those of the first: a stride of RowsView::most_lanes,
  /// lane l at [+ l]. Lanes without a run carry the numbers of the first. False: too many states to do so, nothing
  /// done.
  static bool pass_lanes(std::span<LinearPart* const> parts, const RowsOfPart& rows);
  /// Its states to where the program has them.
  void store(const Program& program, std::vector<double>& x) const;

 private:
  struct Step {
    double h = 0;
    Eigen::MatrixXd state, input, ramp;
  };
  const Step& step_matrices(double h, double rounding);
  void solve_loops(const Program& program, const std::vector<BlockMatrices>& matrices,
                   std::vector<Eigen::RowVectorXd>& rows) const;
  static constexpr std::size_t most_in_registers = 12;
  static constexpr std::size_t most_steps_kept = 1024;  // irregular times: do not grow without bound
  static Step make_step(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double h);
  static Step make_long_step(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double h);
  void find_seen();
  void find_mixing();
  void take_inputs(const std::vector<double>& y);
  void write_outputs(std::vector<double>& y) const;
  bool is_bound_to(const Program& program, const Run& run) const;
  void remember_numbers(const Program& program, const Run& run);
  void make_packed(int kind, double h);
  void forget_many_steps();
  template <int size>
  void pass_of(const RowsOfPart& rows);
  void pass_large(const RowsOfPart& rows);

  std::vector<int> blocks_, inputs_, outputs_;
  std::vector<int> first_state_;   ///< per block
  int n_ = 0;                      ///< states
  bool feeds_through_ = true;      ///< some output needs an input of the same instant
  bool has_loop_ = false;          ///< some of the blocks need each other's outputs at the same instant
  Eigen::MatrixXd a_, b_, c_, d_;  ///< B and D carry the constant part as a last column (its input is 1)
  Eigen::VectorXd x_, next_, w_, w_before_, y_;
  std::vector<Step> cache_;
  std::size_t last_ = 0;
  std::vector<double> bound_to_;  ///< parameters and constants of its blocks
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> to_rest_;
  bool has_to_rest_ = false;

  /// States that some output can see; the others are not advanced by pass(). Of parts whose weights are zero (a fit
  /// asks for the response to one weight after the other) few are left.
  std::vector<int> seen_;
  std::vector<int> mixing_;  ///< places in seen_ of those that move others than themselves
  /// The matrices of a step as pass() reads them, columns of padded_ numbers: what constants add, per input what its
  /// value before and its value now add, per state seen what it adds; of more states than registers hold first the
  /// diagonal of those that mix with none, and columns of the states that do only.
  struct Packed {
    double h = 0;
    std::vector<double> numbers;
  };
  std::vector<Packed> packed_;  ///< per kind; empty where not made
  std::size_t packed_count_ = 0;
  std::size_t padded_ = 0;               ///< number of states seen, made even; of many a multiple of eight
  std::vector<double> c_rows_, d_rows_;  ///< C and D row by row
  std::vector<double> row_scratch_, factors_;
};

}  // namespace hysteron
