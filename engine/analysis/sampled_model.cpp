#include "engine/analysis/sampled_model.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "engine/analysis/wired_slopes.h"
#include "engine/diagram/index.h"
#include "engine/events/clocks.h"
#include "engine/matrices/decompositions.h"
#include "engine/program/steps.h"

namespace hysteron {
namespace {

constexpr std::int64_t most_instants = 20'000;  // in one common period
constexpr double storage = 1e-12;               // poles of a held number

/// [from, to) of the list's indices that are wanted.
std::vector<int> wanted(const std::vector<bool>& list, int from, int to) {
  std::vector<int> indices;
  for (int i = from; i < to; ++i)
    if (list[at(i)]) indices.push_back(i);
  return indices;
}

}  // namespace

SampledModel::SampledModel(const Program& program, const Run& run, const LinearizeOptions& options) {
  const WiredSlopes flattened(program, run, options);
  const Flow flow = flattened.flow();
  const auto between = flattened.between(flow);
  const int n = flattened.states(), s = flattened.sampled_states(), h = flattened.held(), all = n + s + h;
  for (std::size_t q = 0; q < flattened.channels().size(); ++q) {
    if (!between[at(all) + q]) continue;
    const auto& b = program.blocks[at(flattened.channels()[q].block)];
    const bool late = flattened.channels()[q].delay > 0;
    fail("not_linear", b.path,
         fmt::format("{} \"{}\" {} in a sampled loop", b.kernel->declaration.type, b.path,
                     late ? "is a dead time in continuous time, which has no finite number of states,"
                          : "has a describing function with a phase, which no states make,"),
         late ? "count it in samples: a delay_line of whole periods"
              : "open the loop at a sampled block to see the continuous part");
  }
  const std::vector<int> z = wanted(between, 0, n), held = wanted(between, n + s, all);
  std::vector<int> m = wanted(between, n, all), v = z;
  v.insert(v.end(), m.begin(), m.end());
  z_ = static_cast<int>(z.size());
  const auto size = static_cast<Eigen::Index>(v.size()), stored = size - z_;
  const Eigen::Index first_held = size - static_cast<Eigen::Index>(held.size());
  std::vector<int> w;  // of the held outputs in flow.b
  for (const int i : held) w.push_back(i - n - s);
  a_ = Eigen::MatrixXd::Zero(size, size);
  b_ = Eigen::VectorXd::Zero(size);
  c_ = Eigen::RowVectorXd::Zero(size);
  const int to = options.to.front();
  const Eigen::MatrixXd a = flow.a(z, z), b = flow.b(z, w), u = flow.b(z, std::vector<int>{h});
  a_.topLeftCorner(z_, z_) = a;
  a_.block(0, first_held, z_, size - first_held) = b;
  b_.head(z_) = u;
  for (int i = 0; i < z_; ++i) c_(i) = flow.seen_z(to, z[at(i)]);
  for (std::size_t i = 0; i < w.size(); ++i) c_(first_held + static_cast<Eigen::Index>(i)) = flow.seen_w(to, w[i]);
  d_ = flow.seen_w(to, h);
  acts_between_ = !b_.isZero(0);

  std::vector<int> blocks;  // places in program.sampled_blocks that have something to do with it
  int state = n, output = n + s;
  for (std::size_t i = 0; i < program.sampled_blocks.size(); ++i) {
    const auto& sizes = program.blocks[at(program.sampled_blocks[i])].sizes;
    const bool inside = !wanted(between, state, state + sizes.sampled_states).empty() ||
                        !wanted(between, output, output + sizes.outputs).empty();
    if (inside) blocks.push_back(static_cast<int>(i));
    state += sizes.sampled_states;
    output += sizes.outputs;
  }
  find_instants(program, run, blocks);
  for (const auto& due : due_) {
    const Hit hit = flattened.hit(flow, due);
    Instant own{Eigen::MatrixXd::Identity(size, size), Eigen::MatrixXd::Zero(size, 1)};
    std::vector<int> rows;
    for (const int i : m) rows.push_back(i - n);
    own.j.bottomRows(stored) = hit.j(rows, v);
    own.k.bottomRows(stored) = hit.k(rows, std::vector<int>{0});
    instants_.push_back(std::move(own));
  }
  for (std::size_t i = 0; i < intervals_.size(); ++i) {
    intervals_[i].look = acts_between_ || !instants_[at(intervals_[i].hit)].k.isZero(0);
    if (intervals_[i].look) looks_.push_back(static_cast<int>(i));
  }
  if (looks_.empty())  // the input acts at once, or not at all
    for (std::size_t i = 0; i < intervals_.size(); ++i) {
      intervals_[i].look = true;
      looks_.push_back(static_cast<int>(i));
    }
  steps_ = steps(a_, b_);
  phi_ = monodromy(0);
}

void SampledModel::find_instants(const Program& program, const Run& run, const std::vector<int>& blocks) {
  std::vector<Clocking> clocks;
  std::int64_t denominator = 1, common = 1, ticks = 0;
  bool fits = true;
  const auto lcm = [&](std::int64_t a, std::int64_t b) {
    const double size = static_cast<double>(a / std::gcd(a, b)) * static_cast<double>(b);
    fits = fits && size < 9e15;
    return fits ? std::lcm(a, b) : 1;
  };
  for (const int i : blocks) {
    clocks.push_back(clocking_of(program, run, program.sampled_blocks[at(i)]));
    for (const Fraction& f : {clocks.back().period, clocks.back().offset}) {
      fits = fits && f.d > 0;
      if (fits) denominator = lcm(denominator, f.d);
    }
  }
  for (const auto& c : clocks)
    if (fits) common = lcm(common, c.period.n * (denominator / c.period.d));
  std::map<std::int64_t, std::vector<bool>> due;  // ticks within the common period
  for (std::size_t k = 0; k < clocks.size() && fits; ++k) {
    const std::int64_t period = clocks[k].period.n * (denominator / clocks[k].period.d);
    const std::int64_t offset = clocks[k].offset.n * (denominator / clocks[k].offset.d);
    ticks += common / period;
    fits = ticks <= most_instants;
    for (std::int64_t t = offset % period; t < common && fits; t += period) {
      auto& list = due[t];
      list.resize(program.sampled_blocks.size(), false);
      list[at(blocks[k])] = true;
    }
  }
  if (!fits || due.empty())
    fail("no_common_clock", program.blocks[at(program.sampled_blocks[at(blocks.front())])].path,
         fmt::format("the clocks on the way have no common period with at most {} instants", most_instants),
         "write periods that are whole multiples of each other, such as \"0.25 ms\" and \"1 ms\"");
  period_ = static_cast<double>(common) / static_cast<double>(denominator);
  for (auto i = due.begin(); i != due.end(); ++i) {
    const auto known = std::find(due_.begin(), due_.end(), i->second);
    const auto next = std::next(i);
    const std::int64_t until = next == due.end() ? due.begin()->first + common : next->first;
    intervals_.push_back({static_cast<int>(known - due_.begin()),
                          static_cast<double>(until - i->first) / static_cast<double>(denominator)});
    if (known == due_.end()) due_.push_back(i->second);
  }
}

/// `a`, `b`: between the instants.
std::vector<SampledModel::Step> SampledModel::steps(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) const {
  const Eigen::Index n = a.rows();
  std::map<double, Eigen::MatrixXd> known;
  std::vector<Step> list;
  for (const auto& interval : intervals_) {
    Eigen::MatrixXd& e = known[interval.length];
    if (e.size() == 0) {
      Eigen::MatrixXd big = Eigen::MatrixXd::Zero(n + 1, n + 1);
      big.topLeftCorner(n, n) = a * interval.length;
      big.topRightCorner(n, 1) = b * interval.length;
      e = exponential(big);
    }
    const Instant& hit = instants_[at(interval.hit)];
    Step step;
    step.move = e.topLeftCorner(n, n) * hit.j;
    step.push = e.topLeftCorner(n, n) * hit.k + e.topRightCorner(n, 1);
    step.see = c_ * hit.j;
    step.at_once = (c_ * hit.k)(0, 0) + d_;
    list.push_back(std::move(step));
  }
  return list;
}

std::complex<double> SampledModel::response(double w) const {
  const Eigen::Index n = a_.rows();
  Eigen::MatrixXcd left = Eigen::MatrixXcd::Identity(n, n) * std::polar(1.0, w * period_);
  left -= phi_.cast<std::complex<double>>();
  Eigen::VectorXcd v = Eigen::VectorXcd::Zero(n);
  std::complex<double> sum = 0;
  for (const bool settled : {false, true}) {
    if (settled) v = left.partialPivLu().solve(v).eval();
    double t = 0;
    std::complex<double> u = 0;
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      const bool look = intervals_[i].look;
      if (look) u = std::polar(1.0, w * t);
      if (look && settled)
        sum += ((steps_[i].see.cast<std::complex<double>>() * v)(0, 0) + steps_[i].at_once * u) * std::conj(u);
      v = (steps_[i].move * v + steps_[i].push * u).eval();
      t += intervals_[i].length;
    }
  }
  return sum / static_cast<double>(looks());
}

Eigen::MatrixXd SampledModel::monodromy(double gain) const {
  const Eigen::Index n = a_.rows();
  // Where the input acts between the instants, it is fed back there too.
  const double all_the_time = 1 + gain * d_;
  const bool inside = gain != 0 && acts_between_;
  const std::vector<Step> closed =
      inside ? steps(a_ - b_ * (gain / all_the_time) * c_, Eigen::VectorXd::Zero(n)) : std::vector<Step>{};
  Eigen::MatrixXd total = Eigen::MatrixXd::Identity(n, n);
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const Step& step = inside ? closed[i] : steps_[i];
    Eigen::MatrixXd move = step.move;
    if (gain != 0 && intervals_[i].look) move -= step.push * (gain / (1 + gain * step.at_once)) * step.see;
    total = (move * total).eval();
  }
  return total;
}

std::vector<Eigenvalue> SampledModel::poles() const {
  const Eigen::MatrixXd phi = phi_.transpose();  // by rows
  auto list = eigenvalues({phi.data(), static_cast<std::size_t>(phi.size())}, static_cast<int>(phi.rows()));
  std::erase_if(list, [](const Eigenvalue& e) { return std::abs(e.value) <= std::max(storage, e.error); });
  std::stable_sort(list.begin(), list.end(), [](const Eigenvalue& a, const Eigenvalue& b) {
    const double x = std::abs(a.value), y = std::abs(b.value);
    return x != y ? x > y : a.value.imag() > b.value.imag();
  });
  return list;
}

PoleCount SampledModel::unstable() const { return outside_the_circle(poles()); }

PoleCount SampledModel::unstable_when_closed(double gain) const {
  const Eigen::MatrixXd phi = monodromy(gain).transpose();
  return outside_the_circle(
      eigenvalues({phi.data(), static_cast<std::size_t>(phi.size())}, static_cast<int>(phi.rows())));
}

}  // namespace hysteron
