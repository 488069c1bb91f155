#include "engine/program/nominal.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>

#include "engine/program/breakpoints.h"

namespace hysteron {
namespace {

constexpr int pieces_sampled = 16;  // smooth pieces of a source that we look at
constexpr int points_per_piece = 16;
constexpr double periods_without_breakpoints = 4;  // a source without corners: over so many of its periods

bool is_length(const Dimension& d) {
  Dimension metre;
  metre.power[0] = 1;
  return d == metre;
}

/// Calls one block with sizes in place of values.
class Sizer {
 public:
  Sizer(const Program& program, const Run& run) : program_(program), run_(run) {
    sizes_.signals.assign(program.signals.size(), 0.0);
    sizes_.states.assign(static_cast<std::size_t>(program.n_x), 0.0);
  }

  NominalSizes operator()() {
    for (int b = 0; b < count(); ++b)
      if (block(b).n_u == 0) source(b);
    follow_wires();
    fill_unknown_states();
    return std::move(sizes_);
  }

 private:
  int count() const { return static_cast<int>(program_.blocks.size()); }
  const BlockInstance& block(int b) const { return program_.blocks[static_cast<std::size_t>(b)]; }
  double& signal(const BlockInstance& b, int output) {
    return sizes_.signals[static_cast<std::size_t>(b.y_begin + output)];
  }
  double* states(const BlockInstance& b) { return sizes_.states.data() + b.x_begin; }
  std::vector<double> input_sizes(const BlockInstance& b) const {
    std::vector<double> u;
    for (const int s : b.source) u.push_back(sizes_.signals[static_cast<std::size_t>(s)]);
    return u;
  }

  std::vector<double> output_at(int b, const std::vector<double>& x, const std::vector<double>& u, double t,
                                double branch);
  std::vector<double> called(int b, Kernel::Call function, const std::vector<double>& u,
                             const std::vector<double>& rates, int results);
  void source(int b);
  /// What a block's states and outputs are for inputs of these sizes.
  struct Reached {
    std::vector<double> states, outputs;
  };
  Reached reached(int b, const std::vector<double>& u);
  void add_alone(int b, const Reached& r, std::vector<double> u, int signal, std::vector<double>& sum);
  double largest_without_size(int b, const Reached& r, const std::vector<double>& sum);
  void give_sizes(int b, const Reached& r, const std::vector<double>& sum);
  std::vector<double> state_sizes(int b, const std::vector<double>& u);
  void follow_wires();
  void fill_unknown_states();

  const Program& program_;
  const Run& run_;
  NominalSizes sizes_;
};

std::vector<double> Sizer::output_at(int b, const std::vector<double>& x, const std::vector<double>& u, double t,
                                     double branch) {
  const auto& info = block(b);
  auto view = view_of(program_, run_, b);
  view.t = t;
  view.branch = branch;
  view.u = u.data();
  const std::vector<double> sampled(static_cast<std::size_t>(info.sizes.sampled_states));
  view.x = info.hit_index < 0 ? x.data() : sampled.data();
  std::vector<double> memory(static_cast<std::size_t>(info.sizes.memory)),
      y(static_cast<std::size_t>(info.sizes.outputs));
  if (info.kernel->advance != nullptr) {
    view.out = memory.data();
    info.kernel->advance(view);
    view.m = memory.data();
  }
  view.out = y.data();
  info.kernel->output(view);
  return y;
}

std::vector<double> Sizer::called(int b, Kernel::Call function, const std::vector<double>& u,
                                  const std::vector<double>& rates, int results) {
  const std::vector<double> zero(static_cast<std::size_t>(block(b).sizes.states));
  std::vector<double> out(static_cast<std::size_t>(results));
  auto view = view_of(program_, run_, b);
  view.u = u.data();
  view.du = rates.data();
  view.x = zero.data();
  view.out = out.data();
  function(view);
  return out;
}

/// Samples a source piece by piece; its rate by differences inside a piece.
void Sizer::source(int b) {
  const auto& info = block(b);
  const auto* kernel = info.kernel;
  auto view = view_of(program_, run_, b);
  const double shortest_period = kernel->shortest_period != nullptr ? kernel->shortest_period(view) : 0.0;
  double fastest = 0, largest = 0;
  double t = run_.t;
  for (int piece = 0; piece < pieces_sampled; ++piece) {
    view.t = view.branch = t;
    const double breakpoint = kernel->next_breakpoint != nullptr ? breakpoint_behind(program_, run_, b, t)
                                                                 : std::numeric_limits<double>::infinity();
    const bool last = !std::isfinite(breakpoint);
    const double periods = periods_without_breakpoints * shortest_period;
    const double end = last ? t + (periods > 0 && std::isfinite(periods) ? periods : 1.0) : breakpoint;
    const double branch = t + (end - t) / 2;
    const int points = last ? static_cast<int>(periods_without_breakpoints) * points_per_piece : points_per_piece;
    const double step = (end - t) / points;
    std::vector<double> before;
    // Counted: beside a late corner a step may be too short to move the time at all.
    double at = t;
    for (int k = 0; k <= points && at <= end; ++k, at += step) {
      const auto y = output_at(b, {}, {}, at, branch);
      for (std::size_t i = 0; i < y.size(); ++i) {
        auto& size = signal(info, static_cast<int>(i));
        size = std::max(size, std::abs(y[i]));
        largest = std::max(largest, std::abs(y[i]));
        if (!before.empty() && step > 0) fastest = std::max(fastest, std::abs(y[i] - before[i]) / step);
      }
      before = y;
    }
    if (last) break;
    t = end;
  }
  if (info.series_index >= 0 && run_.series[static_cast<std::size_t>(info.series_index)]) {
    const auto& series = *run_.series[static_cast<std::size_t>(info.series_index)];
    for (std::size_t i = 0; i < series.v.size(); ++i) {
      signal(info, 0) = largest = std::max(largest, std::abs(series.v[i]));
      if (i > 0 && series.between == Between::linear)
        fastest = std::max(fastest, std::abs(series.v[i] - series.v[i - 1]) / (series.t[i] - series.t[i - 1]));
    }
  }
  if (const double scale = largest / fastest; fastest > 0 && std::isfinite(scale)) {
    sizes_.time_scale = sizes_.time_scale > 0 ? std::min(sizes_.time_scale, scale) : scale;
  }
}

Sizer::Reached Sizer::reached(int b, const std::vector<double>& u) {
  const auto& info = block(b);
  if (info.history_index >= 0) return {{}, {u.front()}};
  Reached r{{states(info), states(info) + info.sizes.states}, {}};
  if (info.sizes.states > 0 && r.states.front() == 0) r.states = state_sizes(b, u);
  r.outputs = output_at(b, r.states, u, run_.t, run_.branch);
  return r;
}

/// Adds to `sum` what each input does alone that reads this signal: a difference of equals is as large as they are.
void Sizer::add_alone(int b, const Reached& r, std::vector<double> u, int signal, std::vector<double>& sum) {
  const auto& info = block(b);
  if (info.history_index >= 0) return;
  for (std::size_t i = 0; i < u.size(); ++i) {
    if (info.source[i] != signal) continue;
    const double size = std::exchange(u[i], 0.0);
    const auto without = output_at(b, r.states, u, run_.t, run_.branch);
    for (std::size_t k = 0; k < without.size(); ++k) sum[k] += std::abs(r.outputs[k] - without[k]);
    u[i] = size;
  }
}

double Sizer::largest_without_size(int b, const Reached& r, const std::vector<double>& sum) {
  double largest = 0;
  for (std::size_t k = 0; k < r.outputs.size(); ++k)
    if (const double size = std::max(std::abs(r.outputs[k]), sum[k]);
        signal(block(b), static_cast<int>(k)) == 0 && std::isfinite(size))
      largest = std::max(largest, size);
  return largest;
}

void Sizer::give_sizes(int b, const Reached& r, const std::vector<double>& sum) {
  const auto& info = block(b);
  std::copy(r.states.begin(), r.states.end(), states(info));
  for (std::size_t k = 0; k < r.outputs.size(); ++k) {
    double& size = signal(info, static_cast<int>(k));
    const double found = std::max(std::abs(r.outputs[k]), sum[k]);
    if (size == 0 && std::isfinite(found)) size = found;
  }
}

/// Along the wires, the largest first: what comes to a block by several ways has the size of the largest of them, and
/// what has a size keeps it, so that a loop neither grows nor vanishes with its gain. In which order, is told by what
/// each input did alone when its size became known: a block with many inputs is asked twice for each.
void Sizer::follow_wires() {
  std::vector<std::vector<int>> readers(program_.signals.size());
  for (int b = 0; b < count(); ++b)
    for (const int s : block(b).source)
      if (auto& list = readers[static_cast<std::size_t>(s)]; list.empty() || list.back() != b) list.push_back(b);
  const auto blocks = static_cast<std::size_t>(count());
  std::vector<std::vector<double>> sums(blocks);        // per output of each block that waits
  std::vector<double> would_give(blocks);               // the size by which a block waits
  std::priority_queue<std::pair<double, int>> waiting;  // ... and minus its place
  const auto offer = [&](int s) {
    for (const int b : readers[static_cast<std::size_t>(s)]) {
      const auto i = static_cast<std::size_t>(b);
      const auto u = input_sizes(block(b));
      const Reached r = reached(b, u);
      if (sums[i].empty()) sums[i].resize(r.outputs.size());
      add_alone(b, r, u, s, sums[i]);
      would_give[i] = largest_without_size(b, r, sums[i]);
      if (would_give[i] > 0) waiting.emplace(would_give[i], -b);
    }
  };
  for (std::size_t s = 0; s < sizes_.signals.size(); ++s)
    if (sizes_.signals[s] > 0) offer(static_cast<int>(s));
  while (!waiting.empty()) {
    const auto [size, place] = waiting.top();
    waiting.pop();
    const int b = -place;
    const auto& info = block(b);
    if (would_give[static_cast<std::size_t>(b)] != size) continue;  // it waits by another one since
    const auto u = input_sizes(info);
    const Reached r = reached(b, u);
    std::vector<int> known(info.source.begin(), info.source.end());
    std::sort(known.begin(), known.end());
    known.erase(std::unique(known.begin(), known.end()), known.end());
    std::vector<double> sum(r.outputs.size());
    for (const int s : known)
      if (sizes_.signals[static_cast<std::size_t>(s)] > 0) add_alone(b, r, u, s, sum);
    std::vector<int> had_none;
    for (int k = 0; k < info.sizes.outputs; ++k)
      if (signal(info, k) == 0) had_none.push_back(info.y_begin + k);
    give_sizes(b, r, sum);
    would_give[static_cast<std::size_t>(b)] = 0;
    for (const int s : had_none)
      if (sizes_.signals[static_cast<std::size_t>(s)] > 0) offer(s);
  }
}

/// From the declaration; else in equilibrium for inputs of this size; else what the derivative gathers in the time
/// scale of the sources (from rest, where a law does not hold so far from it), though no more than the general guess (a
/// controller's integrator stays small because its error does).
std::vector<double> Sizer::state_sizes(int b, const std::vector<double>& u) {
  const auto& info = block(b);
  const auto n = static_cast<std::size_t>(info.sizes.states);
  std::vector<double> size(n);
  if (info.kernel->rest != nullptr) {
    size = called(b, info.kernel->rest, u, u, info.sizes.states);
    for (auto& s : size) s = std::isfinite(s) ? std::abs(s) : 0.0;
    const double largest = *std::max_element(size.begin(), size.end());
    for (auto& s : size)
      if (s < 1e-6 * largest)
        s = largest;  // the higher states of a balanced form: as large as the first while it moves
  }
  if (sizes_.time_scale > 0 && size.front() == 0) {
    auto rates = u;
    for (auto& r : rates) r /= sizes_.time_scale;
    auto gathered = called(b, info.kernel->derivative, u, rates, info.sizes.states);
    if (!std::all_of(gathered.begin(), gathered.end(), [](double g) { return std::isfinite(g); }))
      gathered = called(b, info.kernel->derivative, std::vector<double>(u.size()), rates, info.sizes.states);
    const double most =
        is_length(program_.signals[static_cast<std::size_t>(info.y_begin)].dimension) ? usual_length : usual_size;
    for (std::size_t i = 0; i < n; ++i)
      size[i] = std::isfinite(gathered[i]) ? std::min(std::abs(gathered[i]) * sizes_.time_scale, most) : 0.0;
  }
  const auto& declared = info.kernel->declaration.states;
  for (std::size_t i = 0; i < n; ++i) {
    const auto k = std::min(i, declared.size() - 1);  // a sized block may declare one state for all of its kind
    if (!declared.empty() && declared[k].nominal_size > 0) size[i] = declared[k].nominal_size;
  }
  return size;
}

void Sizer::fill_unknown_states() {
  for (int b = 0; b < count(); ++b) {
    const auto& info = block(b);
    if (info.sizes.states > 0 && states(info)[0] == 0) {
      const auto size = state_sizes(b, input_sizes(info));
      std::copy(size.begin(), size.end(), states(info));
    }
    const bool length = is_length(program_.signals[static_cast<std::size_t>(info.y_begin)].dimension);
    for (int i = 0; i < info.sizes.states; ++i)
      if (!(states(info)[i] > 0)) states(info)[i] = length ? usual_length : usual_size;
  }
}

}  // namespace

NominalSizes nominal_sizes(const Program& program, const Run& run) { return Sizer(program, run)(); }

std::vector<double> nominal_states(const Program& program, const Run& run) {
  return nominal_sizes(program, run).states;
}

}  // namespace hysteron
