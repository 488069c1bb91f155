// Decides what a guide does that sticks before it slides, as laws of effects: of a mass, and of a motion without one.
#pragma once

#include "discover/hypotheses/effect.h"

namespace hysteron::effects {

/// Beside the spring of a mass: sticks like a spring, slides at a force (Dahl).
Law presliding(const Excitation& at);
/// The same, holding more before it slides fast (Stribeck's excess in LuGre's law).
Law presliding_with_excess(const Excitation& at);

/// On a wire that carries the motion of something without a mass of its own: what the guide holds back is missing from
/// it.
Law guided(const Excitation& at);
Law guided_with_excess(const Excitation& at);

/// A length or an angle.
bool is_motion(const Unit& unit);

}  // namespace hysteron::effects
