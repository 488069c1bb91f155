// Decides what the numbers of a body are called: a mass moves by a force in metres, an inertia turns by a torque in
// radians. One law serves both. Does not decide the laws.
#pragma once

#include <string>

namespace hysteron::blocks {

struct MotionWords {
  const char *body, *body_unit;    ///< "mass", "kg"
  const char *cause, *cause_unit;  ///< "force", "N"
  const char *place, *place_unit;  ///< "position", "m"

  std::string speed_unit() const { return std::string(place_unit) + "/s"; }
  /// Of a force over a power of the place: of a spring.
  std::string per_place(int power = 1) const {
    return std::string(cause_unit) + "/" + place_unit + (power == 1 ? "" : "^" + std::to_string(power));
  }
  std::string damping_unit() const { return std::string(cause_unit) + "*s/" + place_unit; }
  std::string drag_unit() const { return std::string(cause_unit) + "*s^2/" + place_unit + "^2"; }
};

inline constexpr MotionWords translation{"mass", "kg", "force", "N", "position", "m"};
inline constexpr MotionWords rotation{"inertia", "kg*m^2", "torque", "N*m", "angle", "rad"};

}  // namespace hysteron::blocks
