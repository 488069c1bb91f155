// Decides what a random diagram is drawn from: blocks, put one behind the other, a loop, ways to write the same.
// Does not write order, times or methods: random_diagram.h.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "tests/reference/random_diagram.h"
#include "tests/reference/random_numbers.h"

namespace reference {

using Json = nlohmann::ordered_json;

/// "1.234 s": four digits, what stands in the file is what is meant.
std::string with_unit(double value, const std::string& unit);

/// A signal that may be read: its name and about how large it gets.
struct Wire {
  std::string name{};
  double size = 1;
  bool smooth = true;  ///< it does not jump
};

class Generator {
 public:
  explicit Generator(std::uint64_t seed)
      : random(seed),
        draws_drives(seed >= first_seed_with_drives),
        draws_machines(seed >= first_seed_with_machines),
        blocks(Json::object()) {}
  RandomDiagram make();

 private:
  // --- putting blocks down
  std::string fresh() { return "b" + std::to_string(++named); }
  Wire put(Json block, const std::vector<Wire>& in, double size, bool smooth, const std::string& port = "");
  Wire add(Json block, const std::vector<Wire>& in, double size, bool smooth);
  /// The newer ones more often: chains grow long.
  Wire any();
  double around(double size) { return random.between(-0.8, 0.8) * size; }
  // --- sources
  void wave(Json& block);
  Wire source();
  /// A ramp, pulses, trapezoids, or a move within limits.
  Wire piecewise(double a, double o);
  Wire points(double a);
  Wire recording(double a);
  // --- blocks behind others
  using Maker = Wire (Generator::*)(const Wire&);
  Wire grow(const Wire& u);
  Wire gain(const Wire& u);
  Wire sum(const Wire& u);
  Wire product(const Wire& u);
  Wire saturation(const Wire& u);
  Wire dead_zone(const Wire& u);
  Wire rectifier(const Wire& u);
  Wire rounding(const Wire& u);
  Wire relay(const Wire& u);
  Wire expression(const Wire& u);
  Wire table(const Wire& u);
  Wire level(const Wire& u);
  Wire of_two(const Wire& u);
  Wire play(const Wire& u);
  Wire backlash(const Wire& u);
  /// Thresholds from zero and positive weights.
  Json plays_of(const Wire& u, const std::string& type);
  Wire plays(const Wire& u);
  Wire inverse(const Wire& u);
  Wire preisach(const Wire& u);
  Json bouc_wen_numbers(const Wire& u, const std::string& type);
  Wire bouc_wen(const Wire& u);
  Json jiles_atherton_numbers(const Wire& u, const std::string& type);
  Wire jiles_atherton(const Wire& u);
  Wire lag(const Wire& u);
  Wire integrator(const Wire& u);
  Wire resonance(const Wire& u);
  Wire modes(const Wire& u);
  Wire creep(const Wire& u);
  Wire transfer(const Wire& u);
  /// What is known by corner frequencies.
  Wire section(const Wire& u);
  Wire sampled_filter(const Wire& u);
  Wire dead_time(const Wire& u);
  Json sampled(Json block);
  Wire hold(const Wire& u);
  Wire quantizer(const Wire& u);
  Wire delay_line(const Wire& u);
  Wire filter(const Wire& u);
  Json pid_numbers(double size);
  Wire pid(const Wire& u);
  Wire limiter(const Wire& u);
  Wire smooth_curve(const Wire& u);
  /// A force drives it; of its motion a number remains.
  Wire body(const Wire& u);
  // --- parts of drives
  Wire grow_drive(const Wire& u);
  Wire controller(const Wire& u);
  Wire inertia(const Wire& u);
  Wire motor(const Wire& u);
  Wire geared(const Wire& u);
  // --- machines, logic
  /// A signal in a unit, from one without, and a number of it again.
  Wire in_unit(const Wire& u, double most, const std::string& unit);
  Wire told(const Wire& w, double size, const std::string& per_unit);
  /// A block in units of its own, of which the one output is read.
  Wire machine(const Json& block, const std::vector<Wire>& in, double size, const std::string& port);
  Wire grow_machine(const Wire& u);
  Wire function(const Wire& u);
  Wire plain(const Wire& u);
  Wire trigonometry(const Wire& u);
  Wire condition(const Wire& u);
  Wire triggered(const Wire& u);
  /// Hysteresis by a state machine, which stays in one state for a while.
  Wire two_states(const Wire& u);
  /// Integrals that begin anew at a condition, and that stop at limits.
  Wire begun_anew(const Wire& u, const Wire& when);
  Wire stopped(const Wire& u);
  Wire linear(const Wire& u);
  Wire coil(const Wire& u);
  Wire bridge(const Wire& u);
  Wire phases(const Wire& u);
  Wire battery(const Wire& u);
  Wire propeller(const Wire& u);
  Wire arm(const Wire& u);
  Wire rotor(const Wire& u);
  Wire moved(const Wire& u);
  Wire counted(const Wire& u);
  Wire tracking(const Wire& u);
  // --- loops
  /// reference - k measured -> one or two blocks -> what makes it a loop with memory of the past -> measured.
  void loop();
  Wire gain_of(const Wire& u, double g);
  Wire grow_monotone(const Wire& u);
  Wire smooth_saturation(const Wire& u);
  // --- ways to write it
  void choose_something();
  std::string block_of_one_wire();
  void name_a_parameter();
  /// One block, or it and the block that reads it alone, move into a diagram of their own.
  void nest_something();
  RandomDiagram written();

  Random random;
  bool draws_drives, draws_machines;
  Json blocks, parameters = Json::object();
  std::vector<Wire> wires{};
  std::map<std::string, std::string> files{};
  std::set<std::string> dimensioned{};  ///< blocks whose ports have units, or names: they stay where they are
  int named = 0;
};

}  // namespace reference
