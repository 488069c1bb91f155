#include "engine/events/sampling.h"

#include <algorithm>

#include "engine/diagram/index.h"
#include "engine/program/steps.h"

namespace hysteron {

Sampling::Sampling(const Program& program)
    : program_(program), due_(program.sampled_blocks.size(), 0), after_(at(program.n_m)) {}

void Sampling::operator()(Run& run, Work& work, double t, const double* x, std::span<const int> due,
                          const std::vector<Step>& steps) {
  for (const int i : due) {
    due_[at(i)] = 1;
    work.views[at(program_.sampled_blocks[at(i)])].hit = run.hits[at(i)];
  }
  steps::begin(program_, run, work, t);
  work.due = due_.data();
  steps::run(steps, program_, work, x);
  work.due = nullptr;
  for (const int i : due) due_[at(i)] = 0;
  throw_if_unsolved(program_, work, t);
  for (const int i : due) {
    const int block = program_.sampled_blocks[at(i)];
    const BlockInstance& b = program_.blocks[at(block)];
    if (b.kernel->update == nullptr) continue;
    View<double>& v = work.views[at(block)];
    steps::gather(b, work.y, work.u.data() + b.u_begin);
    v.x = v.m;
    v.y = work.y.data() + b.y_begin;
    v.out = after_.data() + b.m_begin;
    b.kernel->update(v);
  }
  for (const int i : due) {
    const BlockInstance& b = program_.blocks[at(program_.sampled_blocks[at(i)])];
    if (b.kernel->update != nullptr)
      std::copy_n(after_.begin() + b.m_begin, b.sizes.sampled_states, run.m.begin() + b.m_begin);
    std::copy_n(work.y.begin() + b.y_begin, b.sizes.outputs, run.m.begin() + b.held_begin());
  }
}

}  // namespace hysteron
