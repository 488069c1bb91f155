// The effect rate_dependence: the hysteretic part of the response follows late.
#include <fmt/format.h>

#include <algorithm>

#include "discover/effects/library.h"

namespace hysteron::effects {
namespace {

/// What comes late: the operators themselves, or how far they are behind the input; all of it, or a share.
Law late(const Circumstances& at, const char* name, const char* part, bool shared) {
  Law law;
  law.name = name;
  law.block.type = "late_prandtl_ishlinskii";
  give(law.block, "time", with_unit(at.shortest_step, parse_unit("s")));
  give(law.block, "share", 1.0);
  give(law.block, "part", part);
  LawParameter time;
  time.path = "time";
  time.start = at.shortest_step;
  time.lower = 1e-4 * at.shortest_step;  // as good as none
  time.upper = std::max(at.longest_recording / 5, 10 * at.shortest_step);
  time.log_scale = true;
  time.scan = per_decade(at.shortest_step / 50, time.upper / 2, 3);
  // lambda 2 pi f <= 0.2 up to the quickest motion that was reported with such laws (Ang 2007; Al Janaideh 2023).
  time.plausible_upper = std::max(1e-3, 0.2 / std::max(at.quickest, 1e-9));
  law.free = {time};
  if (!shared) return law;
  LawParameter share;
  share.path = "share";
  share.start = 1;
  share.lower = -2;
  share.upper = 2;
  share.scan = {1, 0.5};
  share.plausible_lower = 0;
  share.plausible_upper = 1;
  law.free.push_back(share);
  return law;
}

}  // namespace

Effect rate_dependence() {
  Effect e;
  e.id = e.family = "rate_dependence";
  e.title = "Hysteresis that depends on the rate";
  e.cause = "Domain walls need their time: the switched part of the polarisation follows late.";
  e.equation = "y = static - share*(H - h),  time*h' = H - h,  H the hysteretic part of the static response";
  e.source =
      "Ang, Garmon, Khosla, Riviere, IEEE/ASME Trans. Mechatron. 12 (2007) 134; Al Janaideh, Krejci, Appl. Math. 68 "
      "(2023), doi 10.21136/AM.2023.0231-22 (thresholds that grow with the rate: the same for slow motion)";
  e.residual = "The loop grows with the rate; nothing where the motion is too small to switch.";
  e.needs = "A hysteresis in the diagram; three frequencies over 1.5 decades, at two amplitudes.";
  e.way = Way::vary;
  e.variation = "late";
  e.is_memory = true;
  e.parameters = {{"time", "s", "time constant of the late part", "up to 1 ms; 2 pi f time at most 0.2"},
                  {"share", "", "of the hysteretic part which comes late", "0 .. 1"}};
  e.look_alikes = {
      {"amplifier_lag", "high_frequencies", "small motion is late too behind a lag, a hysteresis is not in it"},
      {"sensor_lag", "high_frequencies", "small motion is late too before a lag, a hysteresis is not in it"},
      {"dead_time", "high_frequencies", "small motion is late too behind a delay, a hysteresis is not in it"},
      {"structural_resonance", "high_frequencies", "a resonance rings, at all amplitudes alike"},
      {"creep", "step_hold", "creep goes on in a hold with log t, what is late settles"}};
  e.summary = [](const Law& law, const std::vector<double>& values, const Circumstances&) {
    std::string text = fmt::format("late by {}", time_text(values[0]));
    if (law.free.size() > 1) text += fmt::format(", {:.3g} of it", values[1]);
    return text;
  };
  e.laws = [](const Circumstances& at) {
    return std::vector<Law>{late(at, "late operators", "operators", false), late(at, "late gap", "gap", false),
                            late(at, "a share of the operators late", "operators", true),
                            late(at, "a share of the gap late", "gap", true)};
  };
  e.unseen = stands_still;
  return e;
}

}  // namespace hysteron::effects
