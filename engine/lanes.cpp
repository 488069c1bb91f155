#include "engine/lanes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "engine/lane_arithmetic.h"
#include "engine/lane_grid.h"
#include "engine/lane_shared.h"
#include "engine/needed.h"
#include "engine/simulate_parts.h"
#include "engine/steps.h"

namespace hysteron {
namespace {

using steps::at;

constexpr int width = Lanes::width;

/// Numbers on the boundary of a cache line, so that no vector lies across two.
class Numbers {
 public:
  explicit Numbers(int rows)
      : size_(at(rows) * width),
        data_(static_cast<double*>(std::aligned_alloc(64, std::max<std::size_t>(64, size_ * sizeof(double))))) {
    if (!data_) throw std::bad_alloc();
    std::fill_n(data_.get(), size_, 0.0);
  }
  /// The first of the `width` numbers of row i.
  double* row(int i) { return data_.get() + at(i) * width; }
  double* data() { return data_.get(); }
  std::size_t size() const { return size_; }
  void swap(Numbers& other) { data_.swap(other.data_); }

 private:
  struct Free {
    void operator()(double* p) const { std::free(p); }
  };
  std::size_t size_;
  std::unique_ptr<double[], Free> data_;
};

bool steps_are_fixed(Method method) { return method == Method::euler || method == Method::rk4; }

/// Laws that follow the path of a jump, which lanes do not.
bool follows_jumps(const BlockInstance& b) {
  return b.sizes.memory > 0 || (b.sizes.states > 0 && b.kernel->declaration.is_rate_independent);
}

std::string in_the_way(const BlockInstance& b, const std::string& what) {
  return fmt::format("{} \"{}\" {}", b.kernel->declaration.type, b.path, what);
}

/// A source that may jump, and a law behind it that would follow the jump's path.
std::string why_not_jump(const Program& program) {
  for (std::size_t i = 0; i < program.blocks.size(); ++i) {
    const BlockInstance& b = program.blocks[i];
    const bool held = b.series_index >= 0 && program.series[at(b.series_index)] &&
                      program.series[at(b.series_index)]->between == Between::hold;
    if (!held && b.sizes.smoothness == Smoothness::smooth) continue;
    const auto reached = program.downstream_of(static_cast<int>(i));
    for (std::size_t k = 0; k < reached.size(); ++k)
      if (reached[k] && follows_jumps(program.blocks[k]))
        return in_the_way(b, fmt::format("jumps, and \"{}\" follows the path of a jump", program.blocks[k].path));
  }
  return "";
}

}  // namespace

std::string why_not_in_lanes(const Program& program) {
  for (const Loop& loop : program.loops)
    if (loop.needed)
      return in_the_way(program.blocks[at(loop.blocks.front())],
                        "stands in an algebraic loop, which is solved run by run");
  for (const BlockInstance& b : program.blocks) {
    if (b.mode_index >= 0) return in_the_way(b, "changes its mode at instants of its own in every run");
    if (b.kernel->is_sampled()) return in_the_way(b, "runs at sampling instants");
    if (b.history_index >= 0) return in_the_way(b, "looks back into the past of its input");
  }
  return why_not_jump(program);
}

std::string why_not_in_lanes(const Program& program, const SimulateOptions& options, std::span<const int> parameters) {
  if (auto why = why_not_in_lanes(program); !why.empty()) return why;
  if (!steps_are_fixed(options.method)) {
    if (program.n_x > 0)
      return fmt::format("the method \"{}\" is not one of fixed steps: euler or rk4 with a step go in lanes",
                         method_name(options.method));
    if (program.n_m > 0 && !advances_exactly(program, options))
      return "memory behind a source that turns between the rows: euler or rk4 with a step go in lanes";
  }
  const auto shared = shared_blocks(program, parameters);
  for (std::size_t i = 0; i < shared.size(); ++i)
    if (const BlockInstance& b = program.blocks[i]; !shared[i] && b.kernel->next_corner != nullptr)
      return in_the_way(b, "has corners, and what is varied would move them");
  return "";
}

class Lanes::Advance {
 public:
  Advance(ProgramPointer program, const Run& run, const SimulateOptions& options, std::vector<int> parameters,
          RefusedValues refused);
  std::vector<std::string> operator()(std::span<const double> values, const Sink& sink);
  long rows = 0;

 private:
  /// One step of a list, bound to its numbers.
  struct Call {
    Order order;
    const BlockInstance* block;
    LaneFunctions::Call function;  // null: lane after lane
    LanesView view;
    std::vector<const double*> u, du;
  };
  struct List {
    std::vector<Call> calls;
    SharedNumbers shared;
  };

  List make_list(const std::vector<Step>& steps, std::span<const int> read,
                 std::vector<SharedNumbers::Instant> instants);
  Call bind(const Step& step);
  std::string load(std::span<const double> values, int lane);
  std::string set_values(std::span<const double> values);
  void place(int lane);
  void copy_lane(int from, int to);
  void fill_constants(List& list);
  void evaluate(List& list, std::size_t instant, double t, double branch, const double* x);
  void one_by_one(Call& call);
  void value_of_lane(const Call& call, View<double>& v, int lane);
  void rate_of_lane(const Call& call, const View<double>& v, int lane);
  void take_step(const LanePoint& point, double from);
  void arrive(std::size_t point, const Sink& sink);
  double* number(const Slot& slot) { return (slot.order == Order::value ? y_ : rate_).row(slot.index); }
  static bool is_lane_major(const BlockInstance& b) { return b.kernel->lanes.output == nullptr; }

  ProgramPointer program_;
  SimulateOptions options_;
  std::vector<int> parameters_, signals_;
  RefusedValues refused_;
  Run run_;  // of one lane while it is loaded
  std::vector<int> varied_blocks_;
  std::vector<double> instants_;
  std::vector<LanePoint> points_;
  std::vector<bool> shared_;
  Numbers p_, c_, x_, trial_, before_, dx_, k1_, k2_, k3_, m_, advanced_, y_, rate_, recorded_;
  std::optional<List> derivatives_, values_;
  std::vector<double> u_, du_, out_;
  std::vector<Dual> dual_p_, dual_u_, dual_x_, dual_m_, dual_advanced_, dual_out_;
  long row_ = 0;
};

Lanes::Advance::Advance(ProgramPointer program, const Run& run, const SimulateOptions& options,
                        std::vector<int> parameters, RefusedValues refused)
    : program_(std::move(program)),
      options_(options),
      parameters_(std::move(parameters)),
      signals_(options.signals.empty() ? program_->record_signals : options.signals),
      refused_(refused),
      run_(run),
      instants_(output_instants(options)),
      p_(program_->n_p),
      c_(program_->n_c),
      x_(program_->n_x),
      trial_(program_->n_x),
      before_(program_->n_x),
      dx_(program_->n_x),
      k1_(program_->n_x),
      k2_(program_->n_x),
      k3_(program_->n_x),
      m_(program_->n_m),
      advanced_(program_->n_m),
      y_(program_->n_y),
      rate_(program_->n_y),
      recorded_(static_cast<int>(signals_.size())) {
  if (const auto why = why_not_in_lanes(*program_, options, parameters_); !why.empty())
    fail("not_in_lanes", "/simulate", "runs cannot go side by side: " + why, "run them one after the other");
  check_inputs(*program_, run);
  if (steps_are_fixed(options.method) && !(options.step > 0 && std::isfinite(options.step)))
    fail("bad_value", "/simulate/solver/step", "a method with fixed steps needs the step",
         "give one, such as \"step\": \"10 us\"");
  double off_step = 0;
  points_ = lane_points(*program_, run_, options_, instants_, off_step);
  if (std::isfinite(off_step))
    fail("not_in_lanes", "/simulate/every", fmt::format("the row at {:.9g} s lies inside a step", off_step),
         "give rows a distance that is a multiple of the step");
  rows = static_cast<long>(instants_.size());
  shared_ = shared_blocks(*program_, parameters_);
  for (std::size_t b = 0; b < program_->blocks.size(); ++b)
    for (const int parameter : parameters_)
      for (const int slot : program_->parameters[at(parameter)].slots)
        if (const auto& i = program_->blocks[b]; slot >= i.p_begin && slot < i.p_begin + i.p_at.back())
          if (varied_blocks_.empty() || varied_blocks_.back() != static_cast<int>(b))
            varied_blocks_.push_back(static_cast<int>(b));
  const auto longest = [&](auto count) {
    int n = 0;
    for (const auto& b : program_->blocks) n = std::max(n, count(b));
    return at(n);
  };
  u_.resize(longest([](const BlockInstance& b) { return b.n_u; }));
  du_ = u_;
  dual_u_.resize(u_.size());
  out_.resize(longest([](const BlockInstance& b) { return b.sizes.outputs; }));
  dual_out_.resize(out_.size());
  dual_p_.resize(longest([](const BlockInstance& b) { return b.p_at.back(); }));
  dual_x_.resize(longest([](const BlockInstance& b) { return b.sizes.states; }));
  dual_m_.resize(longest([](const BlockInstance& b) { return b.sizes.memory; }));
  dual_advanced_ = dual_m_;
  std::vector<SharedNumbers::Instant> stages, ends;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const LanePoint& point = points_[i];
    ends.push_back({point.t, point.branch});
    if (i == 0) continue;
    const double from = points_[i - 1].t;
    stages.push_back({from, point.branch_before});
    if (options_.method != Method::rk4) continue;
    stages.push_back({from + point.h / 2, point.branch_before});
    stages.push_back({point.t, point.branch_before});
  }
  if (program_->n_x > 0) derivatives_ = make_list(program_->derivative_steps, {}, std::move(stages));
  values_ =
      make_list(program_->n_m > 0 ? program_->all_values : steps_for(*program_, signals_), signals_, std::move(ends));
  // Parameters and constants that are not varied are the same in all lanes.
  for (int lane = 0; lane < width; ++lane) place(lane);
}

Lanes::Advance::List Lanes::Advance::make_list(const std::vector<Step>& steps, std::span<const int> read,
                                               std::vector<SharedNumbers::Instant> instants) {
  List list{{}, SharedNumbers(program_, run_, steps, shared_, read, std::move(instants))};
  for (const Step& step : steps)
    if (!shared_[at(step.block)]) list.calls.push_back(bind(step));
  for (Call& call : list.calls) {  // pointers into vectors that stay where they are
    call.view.u = call.u.data();
    call.view.du = call.du.data();
  }
  return list;
}

Lanes::Advance::Call Lanes::Advance::bind(const Step& step) {
  const BlockInstance& b = program_->blocks[at(step.block)];
  const LaneFunctions& f = b.kernel->lanes;
  Call call{step.order, &b, nullptr, {}, {}, {}};
  LanesView& v = call.view;
  v.lanes = width;
  v.p = p_.row(b.p_begin);
  v.dx = dx_.row(b.x_begin);
  for (const int s : b.source) {
    call.u.push_back(y_.row(s));
    call.du.push_back(rate_.row(s));
  }
  switch (step.order) {
    case Order::value:
      call.function = f.output;
      v.out = y_.row(b.y_begin);
      break;
    case Order::rate:
      call.function = f.output_rate;
      v.out = rate_.row(b.y_begin);
      v.values = y_.row(b.y_begin);
      break;
    default:
      call.function = f.derivative;
      v.out = dx_.row(b.x_begin);
  }
  return call;
}

std::string Lanes::Advance::set_values(std::span<const double> values) {
  for (std::size_t i = 0; i < parameters_.size(); ++i)
    for (const int slot : program_->parameters[at(parameters_[i])].slots) run_.p[at(slot)] = values[i];
  for (const int block : varied_blocks_) {
    const BlockInstance& b = program_->blocks[at(block)];
    View<double> v = view_of(*program_, run_, block);
    if (b.kernel->check && refused_ == RefusedValues::end_the_lane)
      if (std::string wrong = b.kernel->check(v); !wrong.empty()) return in_the_way(b, "refuses its values: " + wrong);
    if (b.kernel->prepare == nullptr) continue;
    v.out = run_.c.data() + b.c_begin;
    b.kernel->prepare(v);
  }
  return "";
}

/// Values of one sample, and states and memory at the start, to its lane.
std::string Lanes::Advance::load(std::span<const double> values, int lane) {
  if (auto wrong = set_values(values); !wrong.empty()) return wrong;
  run_.t = options_.begin;
  reset(*program_, run_);
  if (options_.at_rest) try {
      settle_at_rest(*program_, run_, options_.begin);
    } catch (const Error& error) {
      return error.problems.front().what;
    }
  place(lane);
  return "";
}

void Lanes::Advance::place(int lane) {
  const auto put = [&](const BlockInstance& b, const std::vector<double>& from, int begin, int count, Numbers& to) {
    const double* numbers = from.data() + begin;
    double* target = to.row(begin);
    if (is_lane_major(b))
      std::copy_n(numbers, count, target + lane * count);
    else
      for (int i = 0; i < count; ++i) target[i * width + lane] = numbers[i];
  };
  for (std::size_t i = 0; i < program_->blocks.size(); ++i) {
    if (shared_[i]) continue;
    const BlockInstance& b = program_->blocks[i];
    put(b, run_.p, b.p_begin, b.p_at.back(), p_);
    put(b, run_.c, b.c_begin, b.sizes.constants, c_);
    put(b, run_.x, b.x_begin, b.sizes.states, x_);
    put(b, run_.m, b.m_begin, b.sizes.memory, m_);
  }
}

void Lanes::Advance::copy_lane(int from, int to) {
  const auto copy = [&](const BlockInstance& b, int begin, int count, Numbers& numbers) {
    double* n = numbers.row(begin);
    if (is_lane_major(b))
      std::copy_n(n + from * count, count, n + to * count);
    else
      for (int i = 0; i < count; ++i) n[i * width + to] = n[i * width + from];
  };
  for (std::size_t i = 0; i < program_->blocks.size(); ++i) {
    if (shared_[i]) continue;
    const BlockInstance& b = program_->blocks[i];
    copy(b, b.p_begin, b.p_at.back(), p_);
    copy(b, b.c_begin, b.sizes.constants, c_);
    copy(b, b.x_begin, b.sizes.states, x_);
    copy(b, b.m_begin, b.sizes.memory, m_);
  }
}

void Lanes::Advance::fill_constants(List& list) {
  const auto& slots = list.shared.slots();
  const double* numbers = list.shared.numbers(0);
  for (std::size_t s = 0; s < slots.size(); ++s)
    if (list.shared.is_constant(s)) lane_fill({number(slots[s]), numbers[s], width});
}

void Lanes::Advance::evaluate(List& list, std::size_t instant, double t, double branch, const double* x) {
  const auto& slots = list.shared.slots();
  const double* numbers = list.shared.numbers(instant);
  for (std::size_t s = 0; s < slots.size(); ++s)
    if (!list.shared.is_constant(s)) lane_fill({number(slots[s]), numbers[s], width});
  for (Call& call : list.calls) {
    const BlockInstance& b = *call.block;
    LanesView& v = call.view;
    v.t = t;
    v.branch = branch;
    v.x = x + at(b.x_begin) * width;
    v.m = m_.row(b.m_begin);
    v.advanced = advanced_.row(b.m_begin);
    if (call.function != nullptr)
      call.function(v);
    else
      one_by_one(call);
  }
}

/// Blocks whose size the diagram decides: one lane behind the other, their numbers lane by lane.
void Lanes::Advance::one_by_one(Call& call) {
  const BlockInstance& b = *call.block;
  View<double> v;
  v.p_at = b.p_at.data();
  v.n_c = b.sizes.constants;
  v.n_x = b.sizes.states;
  v.n_m = b.sizes.memory;
  v.n_u = b.n_u;
  v.n_y = b.sizes.outputs;
  v.key = b.key;
  v.t = call.view.t;
  v.branch = call.view.branch;
  v.series = b.series_index < 0 ? nullptr : run_.series[at(b.series_index)].get();
  v.u = u_.data();
  v.du = du_.data();
  for (int lane = 0; lane < width; ++lane) {
    v.p = call.view.p + lane * b.p_at.back();
    v.c = c_.row(b.c_begin) + lane * v.n_c;
    v.x = call.view.x + lane * v.n_x;
    v.m = call.view.m + lane * v.n_m;
    for (int i = 0; i < b.n_u; ++i) u_[at(i)] = call.u[at(i)][lane];
    if (call.order == Order::rate || b.kernel->derivative_wants_rate)
      for (int i = 0; i < b.n_u; ++i) du_[at(i)] = call.du[at(i)][lane];
    if (call.order == Order::value) {
      value_of_lane(call, v, lane);
    } else if (call.order == Order::rate) {
      rate_of_lane(call, v, lane);
    } else {
      v.out = call.view.out + lane * v.n_x;
      b.kernel->derivative(v);
    }
  }
}

void Lanes::Advance::value_of_lane(const Call& call, View<double>& v, int lane) {
  const Kernel& kernel = *call.block->kernel;
  if (v.n_m > 0) {
    v.out = call.view.advanced + lane * v.n_m;
    kernel.advance(v);
    v.m = v.out;
  }
  v.out = out_.data();
  kernel.output(v);
  for (int i = 0; i < v.n_y; ++i) call.view.out[i * width + lane] = out_[at(i)];
}

void Lanes::Advance::rate_of_lane(const Call& call, const View<double>& v, int lane) {
  const Kernel& kernel = *call.block->kernel;
  const BlockInstance& b = *call.block;
  View<Dual> r;
  for (int i = 0; i < b.p_at.back(); ++i) dual_p_[at(i)] = Dual(v.p[i]);
  for (int i = 0; i < v.n_u; ++i) dual_u_[at(i)] = {u_[at(i)], du_[at(i)]};
  for (int i = 0; i < v.n_x; ++i) dual_x_[at(i)] = {v.x[i], call.view.dx[lane * v.n_x + i]};
  for (int i = 0; i < v.n_m; ++i) dual_m_[at(i)] = Dual(v.m[i]);
  r.p = dual_p_.data();
  r.p_at = v.p_at;
  r.c = v.c;
  r.n_c = v.n_c;
  r.x = dual_x_.data();
  r.n_x = v.n_x;
  r.m = dual_m_.data();
  r.n_m = v.n_m;
  r.u = dual_u_.data();
  r.n_u = v.n_u;
  r.n_y = v.n_y;
  r.key = v.key;
  r.t = {v.t, 1.0};
  r.branch = v.branch;
  r.series = v.series;
  if (v.n_m > 0) {
    r.out = dual_advanced_.data();
    kernel.advance_rate(r);
    r.m = dual_advanced_.data();
  }
  r.out = dual_out_.data();
  kernel.output_rate(r);
  for (int i = 0; i < v.n_y; ++i) call.view.out[i * width + lane] = dual_out_[at(i)].rate;
  if (is_source_of_time(b))
    for (int i = 0; i < v.n_y; ++i) call.view.values[i * width + lane] = dual_out_[at(i)].value;
}

void Lanes::Advance::take_step(const LanePoint& point, double from) {
  const double h = point.h, middle = from + h / 2;
  const std::size_t stages = options_.method == Method::rk4 ? 3 : 1;
  const std::size_t stage = static_cast<std::size_t>(&point - points_.data() - 1) * stages;
  const auto derivative = [&](std::size_t which, double t, Numbers& x, Numbers& k) {
    evaluate(*derivatives_, stage + which, t, point.branch_before, x.data());
    if (&k != &dx_) std::copy_n(dx_.data(), dx_.size(), k.data());
  };
  if (options_.method == Method::euler) {
    derivative(0, from, x_, dx_);
    return lane_move({x_.data(), x_.data(), dx_.data(), h, x_.size()});
  }
  derivative(0, from, x_, k1_);
  lane_move({trial_.data(), x_.data(), k1_.data(), h / 2, x_.size()});
  derivative(1, middle, trial_, k2_);
  lane_move({trial_.data(), x_.data(), k2_.data(), h / 2, x_.size()});
  derivative(1, middle, trial_, k3_);
  lane_move({trial_.data(), x_.data(), k3_.data(), h, x_.size()});
  derivative(2, point.t, trial_, dx_);
  lane_combine({x_.data(), k1_.data(), k2_.data(), k3_.data(), dx_.data(), h, x_.size()});
}

/// Memory is accepted, and rows are handed on.
void Lanes::Advance::arrive(std::size_t point, const Sink& sink) {
  const LanePoint& here = points_[point];
  if (program_->n_m == 0 && here.rows == 0) return;
  evaluate(*values_, point, here.t, here.branch, x_.data());
  m_.swap(advanced_);
  if (here.rows == 0) return;
  for (std::size_t s = 0; s < signals_.size(); ++s)
    std::copy_n(y_.row(signals_[s]), width, recorded_.row(static_cast<int>(s)));
  for (int i = 0; i < here.rows; ++i, ++row_) sink(row_, instants_[at(static_cast<int>(row_))], recorded_.data());
}

std::vector<std::string> Lanes::Advance::operator()(std::span<const double> values, const Sink& sink) {
  const std::size_t n = parameters_.size(), samples = n == 0 ? 1 : values.size() / n;
  std::vector<std::string> results(samples);
  int good = -1;
  for (std::size_t s = 0; s < samples; ++s) {
    results[s] = load(values.subspan(s * n, n), static_cast<int>(s));
    if (results[s].empty() && good < 0) good = static_cast<int>(s);
  }
  if (good < 0) return results;
  for (int lane = 0; lane < width; ++lane)
    if (at(lane) >= samples || !results[at(lane)].empty()) copy_lane(good, lane);
  if (derivatives_) fill_constants(*derivatives_);
  fill_constants(*values_);
  row_ = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (i > 0 && program_->n_x > 0) take_step(points_[i], points_[i - 1].t);
    arrive(i, sink);
  }
  for (const BlockInstance& b : program_->blocks)
    for (std::size_t s = 0; s < samples; ++s)
      for (int i = 0; i < b.sizes.states && results[s].empty(); ++i) {
        const double* x = x_.row(b.x_begin);
        const int lane = static_cast<int>(s);
        if (!std::isfinite(is_lane_major(b) ? x[lane * b.sizes.states + i] : x[i * width + lane]))
          results[s] = in_the_way(b, "runs away: a state of it is not finite at the end");
      }
  return results;
}

Lanes::Lanes(ProgramPointer program, const Run& run, const SimulateOptions& options, std::vector<int> parameters,
             RefusedValues refused)
    : advance_(std::make_unique<Advance>(std::move(program), run, options, std::move(parameters), refused)) {}
Lanes::~Lanes() = default;
Lanes::Lanes(Lanes&&) noexcept = default;
Lanes& Lanes::operator=(Lanes&&) noexcept = default;
std::vector<std::string> Lanes::operator()(std::span<const double> values, const Sink& sink) {
  return (*advance_)(values, sink);
}
long Lanes::rows() const { return advance_->rows; }

}  // namespace hysteron
