// The effect asymmetry: a static curve before the memory.
#include "discover/hypotheses/effect_terms.h"
#include "discover/hypotheses/static_curves.h"

namespace hysteron::effects {
namespace {

/// The curve before the operators, and other weights of these: what bends the drive bends the loops too.
Law reweighed(const Excitation& at) {
  Law law = curve(at, 3);
  law.name = "cubic, with other weights of the operators";
  law.reweighs = true;
  return law;
}

}  // namespace

Effect asymmetry() {
  Effect e = static_curve();
  e.id = e.family = "asymmetry";
  e.title = "Asymmetry";
  e.cause = "Unipolar drive: the low and the high end of the drive, and so both branches, respond differently.";
  e.source = "Gu, Zhu, Su, IEEE Trans. Ind. Electron. 61 (2014) 1583 (cubic input function)";
  e.residual = "Differs between the lower and the upper half of the range; a second harmonic of half the share.";
  e.needs = "Full drive, and small motion about two or more levels.";
  e.unsure = [](const Excitation& at) -> std::string {
    return at.from_data && at.swings.middles < 2 ? "all swings are about one level, two would tell it from the loop"
                                                 : "";
  };
  e.places = {"core"};
  e.before_sensor = true;
  e.laws = [](const Excitation& at) {
    // The cubic first: an S about the middle has nothing quadratic to begin with.
    std::vector<Law> laws{curve(at, 3), curve(at, 2), curve(at, 5)};
    if (!at.weights.empty()) laws.push_back(reweighed(at));
    return laws;
  };
  e.parameters.front().range = "up to 10 % of the linear part";
  e.look_alikes.push_back({"sensor_nonlinearity", "reference_sensor", "a sensor's curve has no memory"});
  return e;
}

}  // namespace hysteron::effects
