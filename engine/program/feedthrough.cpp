#include "engine/program/feedthrough.h"

#include <algorithm>
#include <map>
#include <set>

#include "engine/diagram/index.h"
#include "engine/program/steps.h"

namespace hysteron {
namespace {

/// A number of an evaluation: as a Slot, comparable.
using Place = std::pair<Order, int>;

/// Passes through the steps of a loop, from nothing known: what comes to be known does not depend on itself.
class Passes {
 public:
  Passes(const Program& program, const Loop& loop) : program_(program), loop_(loop) {
    for (const Step& step : loop.steps) {
      for (const auto& place : made_by(step)) inside_.insert(place);
      if (step.order != Order::derivative && !through_.contains(step.block))
        through_[step.block] = feedthrough(program, step.block);
    }
  }

  bool give_all() {
    for (;;) {
      const std::size_t before = known_.size();
      for (const Step& step : loop_.steps) take(step);
      if (known_.size() == inside_.size()) return true;
      if (known_.size() == before) return false;
    }
  }

 private:
  const BlockInstance& block(const Step& step) const { return program_.blocks[at(step.block)]; }
  bool knows(Order order, int index) const {
    return !inside_.contains({order, index}) || known_.contains({order, index});
  }

  std::vector<Place> made_by(const Step& step) const {
    const BlockInstance& b = block(step);
    const bool states = step.order == Order::derivative;
    std::vector<Place> list;
    for (int i = 0; i < (states ? b.sizes.states : b.sizes.outputs); ++i)
      list.emplace_back(step.order, (states ? b.x_begin : b.y_begin) + i);
    return list;
  }

  void take(const Step& step) {
    const BlockInstance& b = block(step);
    const auto made = made_by(step);
    for (std::size_t o = 0; o < made.size(); ++o) {
      bool known = true;
      for (std::size_t i = 0; i < b.source.size(); ++i)
        known = known && (!reads(step, o, i) || knows_input(step, b.source[i]));
      if (step.order == Order::rate) {
        known = known && knows(Order::value, made[o].second);
        for (int i = 0; i < b.sizes.states; ++i) known = known && knows(Order::derivative, b.x_begin + i);
      }
      if (known) known_.insert(made[o]);
    }
  }

  bool reads(const Step& step, std::size_t output, std::size_t input) const {
    if (step.order == Order::derivative) return true;
    return through_.at(step.block)[output * block(step).source.size() + input];
  }

  bool knows_input(const Step& step, int signal) const {
    const bool rate =
        step.order == Order::rate || (step.order == Order::derivative && block(step).kernel->derivative_wants_rate);
    return knows(Order::value, signal) && (!rate || knows(Order::rate, signal));
  }

  const Program& program_;
  const Loop& loop_;
  std::set<Place> inside_, known_;
  std::map<int, std::vector<bool>> through_;
};

}  // namespace

std::vector<bool> feedthrough(const Program& program, int block) {
  const BlockInstance& b = program.blocks[at(block)];
  const auto outputs = at(b.sizes.outputs), inputs = at(b.n_u);
  std::vector<bool> through(outputs * inputs, b.sizes.feedthrough);
  const bool by_entries = b.sizes.feedthrough && b.kernel->declaration.is_linear && !b.kernel->is_sampled() &&
                          b.sizes.memory == 0 && !b.kernel->has_modes();
  if (!by_entries) return through;
  const auto first = program.p.begin() + b.p_begin;
  const std::vector<double> numbers(first, first + b.p_at.back());
  std::vector<double> constants = b.sizes.code;
  constants.resize(at(b.sizes.constants));
  View<double> own;
  own.p = numbers.data();
  own.p_at = b.p_at.data();
  own.n_u = b.n_u;
  own.n_y = b.sizes.outputs;
  own.n_x = b.sizes.states;
  own.out = constants.data();
  if (b.kernel->prepare != nullptr) b.kernel->prepare(own);
  const std::vector<Jet> p(numbers.begin(), numbers.end()), x(at(b.sizes.states));
  std::vector<Jet> u(inputs), y(outputs);
  View<Jet> v;
  v.p = p.data();
  v.p_at = b.p_at.data();
  v.c = constants.data();
  v.n_c = b.sizes.constants;
  v.x = x.data();
  v.n_x = b.sizes.states;
  v.u = u.data();
  v.n_u = b.n_u;
  v.n_y = b.sizes.outputs;
  v.key = b.key;
  v.out = y.data();
  for (std::size_t begin = 0; begin < inputs; begin += Jet::directions) {
    for (std::size_t i = 0; i < inputs; ++i) {
      u[i] = Jet();
      if (i >= begin && i < begin + Jet::directions) u[i].slope[i - begin] = 1;
    }
    b.kernel->jet.output(v);
    for (std::size_t i = begin; i < std::min(inputs, begin + Jet::directions); ++i)
      for (std::size_t o = 0; o < outputs; ++o) through[o * inputs + i] = y[o].slope[i - begin] != 0;
  }
  return through;
}

bool is_algebraic(const Program& program, const Loop& loop) { return !Passes(program, loop).give_all(); }

}  // namespace hysteron
