#include "export/c/c_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "blocks/c_laws.h"
#include "engine/diagram/error.h"
#include "engine/diagram/index.h"
#include "engine/diagram/time_text.h"
#include "engine/events/clocks.h"

namespace hysteron {
namespace {

/// So many of `tick` are `time`; -1 if it is no whole number of them.
long whole_ticks(double time, double tick) {
  const double ratio = time / tick, whole = std::round(ratio);
  return std::fabs(ratio - whole) <= 1e-9 * std::max(1.0, whole) && whole < 1e9 ? static_cast<long>(whole) : -1;
}

double time_of(const Fraction& f) { return static_cast<double>(f.n) / static_cast<double>(f.d); }

class Planning {
 public:
  Planning(ProgramPointer program, double period) : period_(period) {
    plan_.begin = start(*program);
    plan_.program = std::move(program);
    plan_.period = period > 0 ? period : shortest_period(*plan_.program);
    jump_.resize(plan_.program->signals.size());
    moves_.resize(plan_.program->signals.size());
    for (const int input : plan_.program->input_signals) moves_[at(input)] = true;
  }

  CPlan operator()() {
    const Program& program = *plan_.program;
    const std::vector<bool> needed = needed_for_outputs(program);
    plan_.inputs = program.input_signals;
    plan_.outputs = program.output_signals;
    for (std::size_t i = 0; i < program.blocks.size(); ++i)
      if (needed[i]) refuse_what_moves_by_itself(program.blocks[i]);
    refuse_loops(needed);
    for (const Step& step : program.hit_values)
      if (step.order == Order::value && needed[at(step.block)]) add(step.block);
    problems_.throw_if_any();
    mark_before_jumps();
    return std::move(plan_);
  }

 private:
  void refuse(const BlockInstance& b, const std::string& what, const std::string& cure) {
    problems_.add("not_in_c", b.path, fmt::format("{} ({}) {}", b.path, b.kernel->declaration.type, what), cure);
  }
  static bool is_input(const BlockInstance& b) { return b.kernel->declaration.type == "input"; }

  void refuse_what_moves_by_itself(const BlockInstance& b) {
    const auto& d = b.kernel->declaration;
    if (is_input(b)) return;
    if (b.enabling >= 0)
      refuse(b, "stands in a diagram that is switched on and off",
             "write what stands in it into the outermost diagram, with a switch behind it");
    else if (b.kernel->has_modes())
      refuse(b, "changes its law at events between the steps", "name a signal behind it as an input: --from SIGNAL");
    else if (b.sizes.history)
      refuse(b, "remembers the past of its input between the steps",
             "put a delay_line in its place, which delays by whole samples");
    else if (d.is_series || is_source(b))
      refuse(b, "is a signal of time, which the controller is to be given",
             "make it an input of the code:" + as_inputs(b));
    else if (b.sizes.states > 0)
      refuse_continuous(b);
  }
  /// " --from move.position --from move.velocity"
  std::string as_inputs(const BlockInstance& b) const {
    std::string words;
    for (int k = 0; k < b.sizes.outputs; ++k) words += " --from " + plan_.program->signals[at(b.y_begin + k)].path;
    return words;
  }
  static bool is_source(const BlockInstance& b) {
    return is_source_of_time(b) && b.kernel->declaration.type != "constant";
  }
  void refuse_continuous(const BlockInstance& b) {
    const CLaw* law = find_c_law(b.kernel->declaration.type);
    const bool could = b.kernel->declaration.is_linear || (law != nullptr && !law->sampled_type.empty());
    if (could && period_ == 0 && plan_.period == 0)
      refuse(b, "has states that move continuously, and nothing says how often the code runs",
             "say it: --rate \"10 kHz\"");
    else
      refuse(b,
             b.kernel->declaration.is_linear
                 ? "has states that move continuously, and is no linear block of one signal in and one out"
                 : "has states that move continuously and no sampled form",
             "put a sampled block in its place (hysteron blocks, group sampled), or make what is behind it an input: "
             "--from SIGNAL");
  }
  void refuse_loops(const std::vector<bool>& needed) {
    for (const Loop& loop : plan_.program->loops) {
      if (!loop.of_values() ||
          std::none_of(loop.blocks.begin(), loop.blocks.end(), [&](int b) { return needed[at(b)]; }))
        continue;
      std::string names;
      for (const int b : loop.blocks) names += (names.empty() ? "" : ", ") + plan_.program->blocks[at(b)].path;
      problems_.add("not_in_c", plan_.program->blocks[at(loop.blocks.front())].path,
                    "these need each other at the same instant: " + names,
                    "put a delay_line of one sample into the loop, or make one of its signals an input: --from SIGNAL");
    }
  }

  void add(int block) {
    const BlockInstance& b = plan_.program->blocks[at(block)];
    if (is_input(b) || is_source(b) || b.kernel->declaration.is_series || b.sizes.states > 0 || b.kernel->has_modes() ||
        b.sizes.history)
      return;
    const CLaw* law = find_c_law(b.kernel->declaration.type);
    if (law == nullptr || law->code == nullptr) {
      refuse(b, "has no form in C", "make what is behind it an input of the code: --from SIGNAL");
      return;
    }
    View<double> view = view_of(*plan_.program, plan_.begin, block);
    view.n_x = b.kernel->is_sampled() ? b.sizes.sampled_states : b.sizes.states;
    PlannedBlock planned{block, law->code(CBlock{b.shape, view})};
    if (!planned.code.refusal.empty()) {
      const auto cure = planned.code.refusal.find("; ");
      refuse(b, "has no form in C: " + planned.code.refusal.substr(0, cure),
             cure == std::string::npos ? "name a signal behind it as an input: --from SIGNAL"
                                       : planned.code.refusal.substr(cure + 2));
      return;
    }
    if (b.kernel->is_sampled()) clock(b, block, planned);
    follow_jumps(b, block, planned.code);
    plan_.blocks.push_back(std::move(planned));
  }

  /// How a signal goes from its value before an instant to that behind it, while the outputs of sampled blocks jump
  /// along straight ways (engine/events/path.h).
  enum class Way { stands, straight, monotone, turns };
  struct Jump {
    Way way = Way::stands;
    int sampled = -1;  ///< block whose jump it is
    int turned = -1;   ///< block behind which it turns
  };
  /// Memory follows the whole way of a jump in the engine. In the code it sees both ends, which is the same for it
  /// unless the way turns between them.
  void follow_jumps(const BlockInstance& b, int block, const CCode& code) {
    Jump jump;
    if (b.kernel->is_sampled()) {
      jump = {Way::straight, block, -1};
    } else {
      int moving = 0;
      for (const int signal : b.source) {
        const Jump& in = jump_[at(signal)];
        if (in.way == Way::stands) continue;
        ++moving;
        if (in.way > jump.way) jump = in;
      }
      if (jump.way == Way::turns && b.sizes.memory > 0) refuse_jump(b, jump);
      const bool linear = b.kernel->declaration.is_linear;
      if (jump.way == Way::straight && linear) {
        // straight ways add up to a straight one
      } else if (moving == 1 && jump.way != Way::turns && (linear || code.is_monotone)) {
        jump.way = Way::monotone;
      } else if (moving > 0 && jump.way != Way::turns) {
        jump.way = Way::turns;
        jump.turned = block;
      }
    }
    const bool moves = !b.kernel->is_sampled() &&
                       std::any_of(b.source.begin(), b.source.end(), [&](int signal) { return moves_[at(signal)]; });
    if (b.sizes.memory > 0 && moves && jump.way != Way::stands) turning_.push_back(block);
    for (int k = 0; k < b.sizes.outputs; ++k) {
      jump_[at(b.y_begin + k)] = jump;
      moves_[at(b.y_begin + k)] = moves;
    }
  }
  /// From the memory that may turn before a jump back to what is sampled or comes in.
  void mark_before_jumps() {
    std::vector<int> next = turning_;
    plan_.before_jumps = !next.empty();
    while (!next.empty()) {
      const int block = next.back();
      next.pop_back();
      const auto planned = std::find_if(plan_.blocks.begin(), plan_.blocks.end(),
                                        [&](const PlannedBlock& p) { return p.block == block; });
      if (planned == plan_.blocks.end() || planned->before_jumps) continue;
      planned->before_jumps = true;
      const BlockInstance& b = plan_.program->blocks[at(block)];
      if (b.kernel->is_sampled()) continue;
      for (const int signal : b.source) next.push_back(plan_.program->signals[at(signal)].block);
    }
  }
  void refuse_jump(const BlockInstance& b, const Jump& jump) {
    const BlockInstance& turned = plan_.program->blocks[at(jump.turned)];
    const std::string& sampled = plan_.program->blocks[at(jump.sampled)].path;
    refuse(
        b,
        fmt::format("remembers every value on the way of a jump: {} is sampled and jumps, {} ({}) may turn on the way, "
                    "and the code sees no value between its steps",
                    sampled, turned.path, turned.kernel->declaration.type),
        fmt::format("make the sampled signal an input of the code: --from {}", sampled));
  }
  void clock(const BlockInstance& b, int block, PlannedBlock& planned) {
    const Clocking clocking = clocking_of(*plan_.program, plan_.begin, block);
    const double period = time_of(clocking.period), offset = time_of(clocking.offset);
    planned.every = whole_ticks(period, plan_.period);
    planned.first = whole_ticks(offset, plan_.period);
    if (planned.every >= 1 && planned.first >= 0) return;
    refuse(b,
           fmt::format("runs every {} from {} on, which are no whole numbers of steps of {}", time_text(period),
                       time_text(offset), time_text(plan_.period)),
           "give a --rate of which every period and offset is a whole number of steps");
  }

  double period_;
  CPlan plan_;
  std::vector<Jump> jump_;    // per signal
  std::vector<bool> moves_;   // per signal: with the inputs, from step to step
  std::vector<int> turning_;  // memory that may turn where a movement ends and a jump begins
  Problems problems_;
};

}  // namespace

std::vector<bool> needed_for_outputs(const Program& program) {
  std::vector<bool> needed(program.blocks.size(), false);
  std::vector<int> next;
  const auto read = [&](int signal) {
    const int block = program.signals[at(signal)].block;
    if (!needed[at(block)]) next.push_back(block);
    needed[at(block)] = true;
  };
  for (const int signal : program.output_signals) read(signal);
  while (!next.empty()) {
    const int block = next.back();
    next.pop_back();
    for (const int signal : program.blocks[at(block)].source) read(signal);
    const int enabling = program.blocks[at(block)].enabling;
    if (enabling < 0) continue;
    const int by = program.enablings[at(enabling)].block;
    if (!needed[at(by)]) next.push_back(by);
    needed[at(by)] = true;
  }
  return needed;
}

double shortest_period(const Program& program) {
  const Run run = start(program);
  const std::vector<bool> needed = needed_for_outputs(program);
  double shortest = 0;
  for (const int block : program.sampled_blocks) {
    if (!needed[at(block)]) continue;
    const double period = time_of(clocking_of(program, run, block).period);
    if (shortest == 0 || period < shortest) shortest = period;
  }
  return shortest;
}

CPlan plan_c(const ProgramPointer& program, double period) { return Planning(program, period)(); }

}  // namespace hysteron
