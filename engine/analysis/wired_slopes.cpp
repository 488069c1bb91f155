#include "engine/analysis/wired_slopes.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <Eigen/SparseLU>
#include <algorithm>

#include "engine/analysis/block_slopes.h"
#include "engine/analysis/describing_function.h"
#include "engine/diagram/index.h"
#include "engine/program/reach.h"
#include "engine/program/steps.h"

namespace hysteron {

WiredSlopes::WiredSlopes(const Program& program, const Run& run, const LinearizeOptions& options)
    : program_(program),
      options_(options),
      masked_(program.signals.size(), false),
      about_amplitude_(program.blocks.size(), false),
      off_(program.blocks.size(), false),
      n_x_(program.n_x) {
  for (std::size_t b = 0; b < off_.size(); ++b) off_[b] = is_off(program, run, program.blocks[b]);
  LocalSlopes local(program, run);
  for (const int s : options.open) masked_[at(s)] = true;
  for (std::size_t b = 0; b < program.blocks.size(); ++b) {
    const auto& block = program.blocks[b];
    slopes_.push_back(local(static_cast<int>(b)));
    if (block.history_index < 0) continue;
    const double delay = block.kernel->reach_back(view_of(program, run, static_cast<int>(b)));
    channels_.push_back({static_cast<int>(b), block.source.front(), block.y_begin, delay, 1.0});
    masked_[at(block.y_begin)] = true;
  }
  for (const auto& about : options.amplitudes) {
    about_amplitude_[at(about.block)] = true;
    const auto& source = program.blocks[at(about.block)].source;
    const double centre = source.empty() ? 0 : local.value(source.front());
    replace(about.block, describing_function(program, run, about.block, centre, about.amplitude));
  }
  for (const int b : program.sampled_blocks) {
    s_begin_.push_back(n_s_);
    h_begin_.push_back(n_h_);
    n_s_ += program.blocks[at(b)].sizes.sampled_states;
    n_h_ += program.blocks[at(b)].sizes.outputs;
  }
}

WiredSlopes::~WiredSlopes() = default;

/// A real describing function is a gain; one with a phase, which no states make, feeds the signal from outside.
void WiredSlopes::replace(int block, const std::vector<std::complex<double>>& factors) {
  const auto& b = program_.blocks[at(block)];
  BlockSlopes& s = slopes_[at(block)];
  for (auto* part : {&s.a, &s.b, &s.r, &s.c, &s.d}) part->setZero();
  for (std::size_t o = 0; o < factors.size(); ++o) {
    const int signal = b.y_begin + static_cast<int>(o);
    if (factors[o].imag() == 0) {
      s.d(static_cast<Eigen::Index>(o), 0) = factors[o].real();
    } else if (!masked_[at(signal)]) {
      masked_[at(signal)] = true;
      channels_.push_back({block, b.source.front(), signal, 0, factors[o]});
    }
  }
}

/// Columns: x, sampled states, held outputs, signals moved from outside, channels.
Eigen::MatrixXd WiredSlopes::seen(const std::vector<bool>& due) const {
  const int n_y = program_.n_y;
  std::vector<Eigen::Triplet<double>> left;
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(n_y, columns());
  for (std::size_t b = 0; b < program_.blocks.size(); ++b) {
    const BlockInstance& block = program_.blocks[b];
    const BlockSlopes& s = slopes_[b];
    const bool holds = block.hit_index >= 0 && !due[at(block.hit_index)];
    for (int o = 0; o < block.sizes.outputs; ++o) {
      const int y = block.y_begin + o;
      left.emplace_back(y, y, 1.0);
      if (masked_[at(y)]) continue;
      if (holds) {
        right(y, n_x_ + n_s_ + h_begin_[at(block.hit_index)] + o) = 1;
        continue;
      }
      const int x = block.hit_index >= 0 ? n_x_ + s_begin_[at(block.hit_index)] : block.x_begin;
      for (int i = 0; i < s.c.cols(); ++i) right(y, x + i) = s.c(o, i);
      for (int i = 0; i < block.n_u; ++i)
        if (s.d(o, i) != 0) left.emplace_back(y, block.source[at(i)], -s.d(o, i));
    }
  }
  int column = n_x_ + n_s_ + n_h_;
  for (const int s : options_.from) right(s, column++) += 1;
  for (const auto& channel : channels_) {
    // Where the loop is opened at a dead time, its output goes nowhere.
    const bool open = std::find(options_.open.begin(), options_.open.end(), channel.signal) != options_.open.end();
    right(channel.signal, column++) += open ? 0 : 1;
  }
  Eigen::SparseMatrix<double> matrix(n_y, n_y);
  matrix.setFromTriplets(left.begin(), left.end());
  Eigen::SparseLU<Eigen::SparseMatrix<double>> solver;
  solver.compute(matrix);
  if (solver.info() != Eigen::Success)
    fail("not_linear", "", "an algebraic loop of this diagram has gain one here: its slopes have no finite value",
         "take another operating point (--at), or put a block with a state into the loop");
  return solver.solve(right);
}

Eigen::MatrixXd WiredSlopes::gathered(const Eigen::MatrixXd& seen, int block) const {
  const auto& source = program_.blocks[at(block)].source;
  Eigen::MatrixXd u(static_cast<Eigen::Index>(source.size()), seen.cols());
  for (std::size_t i = 0; i < source.size(); ++i) u.row(static_cast<Eigen::Index>(i)) = seen.row(source[i]);
  return u;
}

Flow WiredSlopes::flow() const {
  const Eigen::MatrixXd all = seen(std::vector<bool>(program_.sampled_blocks.size(), false));
  Eigen::MatrixXd f = Eigen::MatrixXd::Zero(n_x_, columns()), r = f;
  for (std::size_t b = 0; b < program_.blocks.size(); ++b) {
    const BlockInstance& block = program_.blocks[b];
    const int n = block.hit_index >= 0 ? 0 : block.sizes.states;
    if (n == 0) continue;
    const BlockSlopes& s = slopes_[b];
    const Eigen::MatrixXd u = gathered(all, static_cast<int>(b));
    f.middleRows(block.x_begin, n) += s.b * u;
    f.block(block.x_begin, block.x_begin, n, n) += s.a;
    if (!s.r.isZero(0)) r.middleRows(block.x_begin, n) += s.r * u;
  }
  const int w = columns() - n_x_ - n_s_;
  Flow flow;
  if (!r.isZero(0)) {
    // (1 - R_x) x' = F + R_w w'
    const Eigen::PartialPivLU<Eigen::MatrixXd> own(Eigen::MatrixXd::Identity(n_x_, n_x_) - r.leftCols(n_x_));
    f = own.solve(f).eval();
    flow.taken = own.solve(r.rightCols(w));
  } else {
    flow.taken = Eigen::MatrixXd::Zero(n_x_, w);
  }
  flow.a = f.leftCols(n_x_);
  flow.b = f.rightCols(w) + flow.a * flow.taken;
  flow.seen_z = all.leftCols(n_x_);
  flow.seen_w = all.rightCols(w) + flow.seen_z * flow.taken;
  return flow;
}

Hit WiredSlopes::hit(const Flow& flow, const std::vector<bool>& due) const {
  const int n_m = n_s_ + n_h_, v = columns() - n_x_ - n_m;
  Eigen::MatrixXd all = seen(due);  // in x; z once what was taken over is added
  all.rightCols(n_h_ + v) += all.leftCols(n_x_) * flow.taken;
  Hit hit{Eigen::MatrixXd::Zero(n_m, n_x_ + n_m), Eigen::MatrixXd::Zero(n_m, v)};
  for (std::size_t i = 0; i < program_.sampled_blocks.size(); ++i) {
    const BlockInstance& block = program_.blocks[at(program_.sampled_blocks[i])];
    const int s = block.sizes.sampled_states, h = block.sizes.outputs;
    const int s_row = s_begin_[i], h_row = n_s_ + h_begin_[i];
    if (!due[i]) {
      hit.j.block(s_row, n_x_ + s_row, s, s).setIdentity();
      hit.j.block(h_row, n_x_ + h_row, h, h).setIdentity();
      continue;
    }
    const BlockSlopes& own = slopes_[at(program_.sampled_blocks[i])];
    const Eigen::MatrixXd u = gathered(all, program_.sampled_blocks[i]);
    hit.j.middleRows(s_row, s) = own.b * u.leftCols(n_x_ + n_m);
    hit.j.block(s_row, n_x_ + s_row, s, s) += own.a;
    hit.k.middleRows(s_row, s) = own.b * u.rightCols(v);
    hit.j.middleRows(h_row, h) = own.d * u.leftCols(n_x_ + n_m);
    hit.j.block(h_row, n_x_ + s_row, h, s) += own.c;
    hit.k.middleRows(h_row, h) = own.d * u.rightCols(v);
  }
  return hit;
}

std::vector<bool> WiredSlopes::between(const Flow& flow) const {
  const int n = n_x_, h = n_h_, m = n_s_ + h, v = inputs();
  const int k = static_cast<int>(channels_.size());
  Reach reach(n + m + k);
  const auto from_w = [&](int row, const auto& coefficients) {  // of w = (held, inputs, channels)
    for (int j = 0; j < h; ++j)
      if (coefficients(j) != 0) reach.add(n + n_s_ + j, row);
    for (int j = 0; j < v; ++j)
      if (coefficients(h + j) != 0) reach.enters(row);
    for (int j = 0; j < k; ++j)
      if (coefficients(h + v + j) != 0) reach.add(n + m + j, row);
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j)
      if (flow.a(i, j) != 0) reach.add(j, i);
    from_w(i, flow.b.row(i));
  }
  for (int q = 0; q < k; ++q) {
    const int source = channels_[at(q)].source;
    for (int j = 0; j < n; ++j)
      if (flow.seen_z(source, j) != 0) reach.add(j, n + m + q);
    from_w(n + m + q, flow.seen_w.row(source));
  }
  // Each sampled block at an instant of its own: what several do together is made of such ways.
  for (std::size_t c = 0; c < program_.sampled_blocks.size(); ++c) {
    std::vector<bool> due(program_.sampled_blocks.size(), false);
    due[c] = true;
    const Hit alone = hit(flow, due);
    const auto& sizes = program_.blocks[at(program_.sampled_blocks[c])].sizes;
    const auto add_row = [&](int i) {
      for (int j = 0; j < n + m; ++j)
        if (alone.j(i, j) != 0) reach.add(j, n + i);
      for (int j = 0; j < v; ++j)
        if (alone.k(i, j) != 0) reach.enters(n + i);
      for (int j = 0; j < k; ++j)
        if (alone.k(i, v + j) != 0) reach.add(n + m + j, n + i);
    };
    for (int i = 0; i < sizes.sampled_states; ++i) add_row(s_begin_[c] + i);
    for (int i = 0; i < sizes.outputs; ++i) add_row(n_s_ + h_begin_[c] + i);
  }
  for (const int s : options_.to) {
    for (int j = 0; j < n; ++j)
      if (flow.seen_z(s, j) != 0) reach.leaves(j);
    for (int j = 0; j < h; ++j)
      if (flow.seen_w(s, j) != 0) reach.leaves(n + n_s_ + j);
    for (int j = 0; j < k; ++j)
      if (flow.seen_w(s, h + v + j) != 0) reach.leaves(n + m + j);
  }
  return reach.between();
}

std::vector<int> WiredSlopes::cuts() const {
  // By wires alone: what would be reached if every block passed something on.
  std::vector<std::vector<int>> readers(program_.signals.size());
  for (std::size_t b = 0; b < program_.blocks.size(); ++b)
    for (const int s : program_.blocks[b].source) readers[at(s)].push_back(static_cast<int>(b));
  const auto opened = [&](int s) {
    return std::find(options_.open.begin(), options_.open.end(), s) != options_.open.end();
  };
  const auto outputs = [&](int b) {
    std::vector<int> list;
    for (int o = 0; o < program_.blocks[at(b)].sizes.outputs; ++o) list.push_back(program_.blocks[at(b)].y_begin + o);
    return list;
  };
  std::vector<bool> arrives(program_.blocks.size(), false), awaited(program_.blocks.size(), false);
  std::vector<int> todo;
  for (const int s : options_.from) todo.insert(todo.end(), readers[at(s)].begin(), readers[at(s)].end());
  while (!todo.empty()) {
    const int b = todo.back();
    todo.pop_back();
    if (arrives[at(b)]) continue;
    arrives[at(b)] = true;
    for (const int s : outputs(b))
      if (!opened(s)) todo.insert(todo.end(), readers[at(s)].begin(), readers[at(s)].end());
  }
  for (const int s : options_.to) todo.push_back(program_.signals[at(s)].block);
  while (!todo.empty()) {
    const int b = todo.back();
    todo.pop_back();
    if (awaited[at(b)]) continue;
    awaited[at(b)] = true;
    for (const int s : program_.blocks[at(b)].source)
      if (!opened(s)) todo.push_back(program_.signals[at(s)].block);
  }
  std::vector<int> list;
  for (std::size_t b = 0; b < program_.blocks.size(); ++b) {
    const auto& block = program_.blocks[b];
    // A linear block of gain zero is meant so, a dead time answers later.
    const bool may_cut =
        off_[b] || (!block.kernel->declaration.is_linear && block.history_index < 0 && !about_amplitude_[b]);
    if (may_cut && arrives[b] && awaited[b] && slopes_[b].cuts()) list.push_back(static_cast<int>(b));
  }
  return list;
}

}  // namespace hysteron
