// Decides at which temperature a device is usually calibrated.
#pragma once

#include <algorithm>

namespace hysteron::effects {

/// [K] A room of 20 .. 25 degC: of it what is nearest to `temperature`.
inline double usual_room(double temperature) { return std::clamp(temperature, 293.15, 298.15); }

}  // namespace hysteron::effects
