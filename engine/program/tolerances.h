// Decides how exact a simulation is where nobody says: what the integrators hold (simulate.h), and what the algebraic
// loops of a run are solved to before a simulation asks for more (loops.h).
#pragma once

namespace hysteron {

inline constexpr double default_relative_tolerance = 1e-6;
inline constexpr double default_absolute_tolerance =
    1e-2;  ///< as a multiple of the relative one times the nominal size

}  // namespace hysteron
