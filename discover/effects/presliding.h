// Decides what a guide does that sticks before it slides, as laws of effects: of a mass, of a motion without one, and
// of a bearing beside its damping.
#pragma once

#include <string>
#include <vector>

#include "discover/hypotheses/effect.h"

namespace hysteron::effects {

/// Of a mass or an inertia on a linear spring, or one that bends: holds with the same force at any speed, sticks
/// without giving way (Coulomb), and with more at low speed (Stribeck). Where the block has such a variation.
bool can_be_dry(const Excitation& at);
Law dry(const Excitation& at);
Law dry_with_excess(const Excitation& at);        ///< that falls as Gauss's bell
Law dry_with_quick_excess(const Excitation& at);  ///< that falls as an exponential
bool is_dry(const Law& law);

/// Beside the spring of a mass: sticks like a spring, slides at a force (Dahl).
Law presliding(const Excitation& at);
/// The same, holding more before it slides fast (Stribeck's excess in LuGre's law).
Law presliding_with_excess(const Excitation& at);

/// On a wire that carries the motion of something without a mass of its own: what the guide holds back is missing from
/// it.
Law guided(const Excitation& at);
Law guided_with_excess(const Excitation& at);

/// Before a damping, on the speed: dry friction beside it (Dahl), and with Stribeck's excess.
Law beside_damping(const Excitation& at);
Law beside_damping_with_excess(const Excitation& at);
/// What these say, values as Law::free; `at` has a damping.
std::string told_beside_damping(const std::vector<double>& values, const Excitation& at);

/// Why it cannot be seen beside a damping of 0, over which it is told.
inline constexpr const char* no_damping = "the damping there is 0, and friction is told over it: give the gain a value";

/// Of a wire that carries a speed: its largest [SI], never 0.
double fastest(const Excitation& at);
/// There the way from sticking to sliding, written into the law's block. What is much shorter than the way in one row
/// at full speed is a switch between two rows.
LawParameter give_slip_distance(Law& law, const Excitation& at);

/// What dry friction of an integrator says, values as Law::free.
std::string told_of_a_speed(const std::vector<double>& values, const Excitation& at);

/// A length or an angle.
bool is_motion(const Unit& unit);
/// What changes them in time.
bool is_speed(const Unit& unit);

}  // namespace hysteron::effects
