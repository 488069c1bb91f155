// The effect rate_dependence: the hysteretic part of the response follows late.
#include <fmt/format.h>

#include <algorithm>

#include "discover/hypotheses/effect_terms.h"

namespace hysteron::effects {
namespace {

constexpr double least_ahead =
    -0.5;  // of the input; below 0 it is late itself, and a lag that must be looked for there

/// The operators come late, or how far they are behind the input (ahead = 1); richer: wide loops later than small ones,
/// and only a share.
Law late(const Excitation& at, const char* name, bool spread, bool shared) {
  Law law;
  law.name = name;
  law.block.type = "late_prandtl_ishlinskii";
  give(law.block, "time", with_unit(at.shortest_step, parse_unit("s")));
  give(law.block, "share", 1.0);
  give(law.block, "ahead", 1.0);
  LawParameter time;
  time.path = "time";
  time.start = at.shortest_step;
  time.lower = 1e-5 * at.shortest_step;  // as good as none
  time.upper = std::max(at.longest_recording / 5, 10 * at.shortest_step);
  time.log_scale = true;
  time.scan = per_decade(at.shortest_step / 1000, time.upper / 2, 3);
  // lambda 2 pi f <= 0.2 up to the quickest motion that was reported with such laws (Ang 2007; Al Janaideh 2023).
  time.plausible_upper = std::max(1e-3, 0.2 / std::max(at.quickest, 1e-9));
  LawParameter ahead;
  ahead.path = "ahead";
  ahead.start = 1;
  ahead.lower = least_ahead;
  ahead.upper = 1.5;
  ahead.scan = {1, 0};
  law.free = {time, ahead};
  const auto further = [&](const char* path, double start, double lower, double upper, std::vector<double> scan) {
    give(law.block, path, start);
    LawParameter p;
    p.path = path;
    p.start = start;
    p.lower = lower;
    p.upper = upper;
    p.scan = std::move(scan);
    law.free.push_back(std::move(p));
  };
  if (spread) further("spread", 0, -1, 3, {0, 0.5, 1});
  if (shared) further("share", 1, 0, 2, {1, 0.5});
  return law;
}

}  // namespace

Effect rate_dependence() {
  Effect e;
  e.id = e.family = "rate_dependence";
  e.title = "Hysteresis that depends on the rate";
  e.cause = "Domain walls need their time: the switched part of the polarisation follows late.";
  e.equation = "y = sum w_i*(z_i - share*(q_i - h_i)),  time_i*h_i' = q_i - h_i,  q_i = z_i - ahead*u";
  e.source =
      "Ang, Garmon, Khosla, Riviere, IEEE/ASME Trans. Mechatron. 12 (2007) 134; Al Janaideh, Krejci, Appl. Math. 68 "
      "(2023), doi 10.21136/AM.2023.0231-22 (thresholds that grow with the rate: the same for slow motion)";
  e.residual = "The loop grows with the rate; nothing where the motion is too small to switch.";
  e.needs = "A hysteresis in the diagram; three frequencies over 1.5 decades, at two amplitudes.";
  e.way = Way::vary;
  e.variation = "late";
  e.is_memory = true;
  e.parameters = {{"time", "s", "time constant of the late part", "up to 1 ms; 2 pi f time at most 0.2"},
                  {"ahead", "", "part of the input that is not late: 0 the operators are late, 1 their gap", "0 .. 1"},
                  {"spread, share", "", "wide loops later than small ones; share that is late", "0 .. 1"}};
  e.look_alikes = {
      {"amplifier_lag", "high_frequencies", "small motion is late too behind a lag, a hysteresis is not in it"},
      {"sensor_lag", "high_frequencies", "small motion is late too before a lag, a hysteresis is not in it"},
      {"dead_time", "high_frequencies", "small motion is late too behind a delay, a hysteresis is not in it"},
      {"structural_resonance", "high_frequencies", "a resonance rings, at all amplitudes alike"},
      {"creep", "step_hold", "creep goes on in a hold with log t, what is late settles"}};
  e.summary = [](const Law& law, const std::vector<double>& values, const Excitation&) {
    std::string text = fmt::format("late by {}, {:.2g} of the input ahead", time_text(values[0]), values[1]);
    if (law.free.size() > 2) text += fmt::format(", times to the power {:.2g} of the threshold", values[2]);
    return text;
  };
  e.laws = [](const Excitation& at) {
    return std::vector<Law>{late(at, "one time", false, false),
                            late(at, "times that grow with the threshold", true, false),
                            late(at, "a share, with times that grow", true, true)};
  };
  e.implausible = [](const Law&, const std::vector<double>& values, const Excitation&) -> std::string {
    if (values[1] > 0.99 * least_ahead) return "";
    return fmt::format("with {:.2g} of the input ahead, the limit, small motion is late too, as behind a lag",
                       values[1]);
  };
  e.unsure = [](const Excitation& at) -> std::string {
    if (at.from_data && at.swings.sizes < 2) return "swings of one size, two would tell it from a lag";
    return one_speed(at, 30, "tell it from a wider loop");
  };
  e.unseen = stands_still;
  return e;
}

}  // namespace hysteron::effects
