// Which types random diagrams draw: all, but for those of the table below, each with the reason.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "blocks/register_all.h"
#include "tests/reference/random_diagram.h"

namespace reference {
namespace {

constexpr const char* draws_numbers = "its random numbers are the program's own";
constexpr const char* vectors = "random diagrams have scalar wires: tests/blocks/vectors";
constexpr const char* model = "made from a model within it: tests/blocks/sampled, against models of their own";
constexpr const char* inverse = "an inverse: tests/blocks/laws_in_diagrams_test.cpp puts it before its law";
constexpr const char* material = "tests/models and tests/blocks/hysteresis";
constexpr const char* effect = "what an effect puts in: tests/discover hide it by formulas of their own";
constexpr const char* other_program = "another simulator's program: tests/interop/fmi";
constexpr const char* late = "the reference reads its past by delays that do not change: tests/blocks/continuous";
constexpr const char* at_limits =
    "it is held at limits within the reference's steps: tests/blocks/events_in_diagrams_test.cpp";

const std::map<std::string, const char*>& never_drawn() {
  static const std::map<std::string, const char*> all{{"multisine", draws_numbers},
                                                      {"noise", draws_numbers},
                                                      {"sampled_noise", draws_numbers},
                                                      {"sensor_noise", draws_numbers},
                                                      {"mux", vectors},
                                                      {"demux", vectors},
                                                      {"select", vectors},
                                                      {"matrix_gain", vectors},
                                                      {"observer", model},
                                                      {"kalman_filter", model},
                                                      {"disturbance_observer", model},
                                                      {"repetitive_controller", model},
                                                      {"sampled_bouc_wen_inverse", inverse},
                                                      {"sampled_jiles_atherton_inverse", inverse},
                                                      {"sampled_asymmetric_inverse", inverse},
                                                      {"sampled_tapi_inverse", inverse},
                                                      {"sampled_coupled_tapi_inverse", inverse},
                                                      {"wheatstone_bridge_inverse", inverse},
                                                      {"wheatstone_bridge", material},
                                                      {"maxwell_capacitor", material},
                                                      {"impedance_estimator", material},
                                                      {"thermal_network", material},
                                                      {"tapi", material},
                                                      {"coupled_tapi", material},
                                                      {"temperature_gain", effect},
                                                      {"thermal_expansion", effect},
                                                      {"pyro_charge", effect},
                                                      {"ageing", effect},
                                                      {"sensor_drift", effect},
                                                      {"mains_interference", effect},
                                                      {"logarithmic_creep", effect},
                                                      {"load_dependence", effect},
                                                      {"late_cross_coupling", effect},
                                                      {"generalized_prandtl_ishlinskii", effect},
                                                      {"late_prandtl_ishlinskii", effect},
                                                      {"mass_with_mode", effect},
                                                      {"mass_with_cogging", effect},
                                                      {"periodic_error", effect},
                                                      {"fmu", other_program},
                                                      {"mass_with_drag", effect},
                                                      {"mass_on_spring_of_plays", effect},
                                                      {"mass_on_bouc_wen_spring", effect},
                                                      {"sliding_friction", effect},
                                                      {"bearing_friction", effect},
                                                      {"integrator_with_friction", effect},
                                                      {"guide_friction", effect},
                                                      {"variable_dead_time", late},
                                                      {"current_limit", at_limits},
                                                      {"tank", at_limits}};
  return all;
}

std::set<std::string> types_in(const nlohmann::json& json) {
  std::set<std::string> types;
  if (json.is_object() && json.contains("type") && json["type"].is_string()) types.insert(json["type"]);
  if (json.is_structured())
    for (const auto& inner : json) types.merge(types_in(inner));
  return types;
}

TEST(RandomDiagrams, DrawEveryTypeOrSayWhyNot) {
  std::set<std::string> drawn;
  for (const std::uint64_t first : {std::uint64_t{1}, first_seed_with_drives, first_seed_with_machines})
    for (std::uint64_t seed = first; seed < first + 500; ++seed) {
      const RandomDiagram diagram = random_diagram(seed);
      drawn.merge(types_in(nlohmann::json::parse(diagram.text)));
    }
  const hysteron::Registry registry = hysteron::all_blocks();
  for (const auto& type : registry.types()) {
    if (registry.find(type)->declaration.group == "internal") continue;
    const bool excused = never_drawn().contains(type);
    EXPECT_TRUE(drawn.contains(type) || excused) << type << ": draw it, or say why not";
    EXPECT_FALSE(drawn.contains(type) && excused) << type << " is drawn";
  }
  for (const auto& [type, why] : never_drawn()) EXPECT_NE(registry.find(type), nullptr) << type;
}

}  // namespace
}  // namespace reference
