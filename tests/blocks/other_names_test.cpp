// Words from elsewhere: each leads to types that are here.
#include "blocks/other_names.h"

#include <gtest/gtest.h>

#include <set>

#include "blocks/register_all.h"

namespace hysteron {
namespace {

/// What stands in quotes.
std::vector<std::string> quoted(const std::string& text) {
  std::vector<std::string> words;
  for (auto open = text.find('"'); open != std::string::npos;) {
    const auto close = text.find('"', open + 1);
    words.push_back(text.substr(open + 1, close - open - 1));
    open = text.find('"', close + 1);
  }
  return words;
}

TEST(OtherNames, EachLeadsToATypeOrAKeyThatIsThere) {
  const Registry registry = all_blocks();
  const std::set<std::string> keys{"record", "outputs", "inputs", "diagram"};
  for (const auto& word : other_names()) {
    bool leads = false;
    for (const auto& name : quoted(instead_of_other_name(word)))
      leads = leads || keys.contains(name) || registry.find(name) != nullptr;
    EXPECT_TRUE(leads) << word << ": " << instead_of_other_name(word);
  }
}

TEST(OtherNames, WordsOfTheFieldLeadToWhatTheyAre) {
  const auto says = [](const char* word, const char* type) {
    EXPECT_NE(instead_of_other_name(word).find(std::string("\"") + type + "\""), std::string::npos) << word;
  };
  for (const char* word : {"dead_band", "DeadBand", "dead band", "dead-band"}) says(word, "dead_zone");
  says("clock", "ramp");
  says("square_wave", "pulse");
  says("Repeating Sequence", "time_table");
  says("s-curve", "motion_profile");
  says("Band-Limited White Noise", "noise");
  says("lookup_table", "lookup");
  says("n-D Lookup Table", "lookup");
  says("Fcn", "expression");
  says("MATLAB Function", "expression");
  says("MinMax", "min_max");
  says("Relational Operator", "compare");
  says("Logical Operator", "logic");
  says("Compare To Constant", "comparator");
  says("Trigonometric Function", "trigonometry");
  says("Coulomb & Viscous Friction", "mass_with_friction");
  says("derivative", "filtered_derivative");
  says("Variable Transport Delay", "variable_dead_time");
  says("gearbox", "gear");
  says("Multiport Switch", "switch");
  says("absolute_value", "abs");
  says("transport_delay", "dead_time");
  says("PID Controller", "pid");
  says("Discrete PID", "discrete_pid");
  says("Zero-Pole", "zero_pole_gain");
  says("Discrete State-Space", "discrete_state_space");
  says("Discrete-Time Integrator", "discrete_integrator");
  says("Discrete FIR Filter", "fir");
  says("Butterworth", "digital_filter");
  says("PMSM", "synchronous_motor");
  says("Rate Transition", "sample_hold");
  says("Unit Delay", "delay_line");
  for (const char* word : {"orifice", "valve", "convection", "Radiative Heat Transfer", "Peltier"})
    says(word, "expression");
  EXPECT_EQ(instead_of_other_name("sawn_off"), "");
}

/// What people from Simulink type.
TEST(OtherNames, TheBlocksOfSimulinkLeadSomewhere) {
  std::set<std::string> types;
  for (const auto& type : all_blocks().types()) types.insert(plain_name(type));
  for (const char* name : {"Transport Delay",
                           "Zero-Order Hold",
                           "Unit Delay",
                           "Rate Limiter",
                           "Dead Zone",
                           "Lookup Table",
                           "Derivative",
                           "Clock",
                           "Constant",
                           "Step",
                           "Repeating Sequence",
                           "Sine Wave",
                           "Chirp",
                           "Pulse Generator",
                           "Manual Switch",
                           "Scope",
                           "To Workspace",
                           "Mux",
                           "Demux",
                           "Bus",
                           "Transfer Fcn",
                           "State-Space",
                           "Zero-Pole",
                           "Discrete Filter",
                           "MinMax",
                           "Sign",
                           "Abs",
                           "Math Function",
                           "Saturation",
                           "Quantizer",
                           "Backlash",
                           "Coulomb & Viscous Friction",
                           "Relay",
                           "From Workspace",
                           "Fcn",
                           "Switch",
                           "Sample and Hold",
                           "Logical Operator",
                           "Relational Operator",
                           "PID Controller",
                           "Discrete-Time Integrator",
                           "Ramp",
                           "Sum",
                           "Gain",
                           "Product",
                           "Divide",
                           "Integrator",
                           "Trigonometric Function",
                           "Counter",
                           "Subsystem",
                           "Delay",
                           "Random Number",
                           "Band-Limited White Noise",
                           "Signal Builder",
                           "Compare To Constant",
                           "1-D Lookup Table",
                           "2-D Lookup Table",
                           "n-D Lookup Table"})
    EXPECT_TRUE(types.contains(plain_name(name)) || !instead_of_other_name(name).empty()) << name;
}

TEST(OtherNames, AWordIsThereOnceAndIsNoTypeItself) {
  const Registry registry = all_blocks();
  std::set<std::string> seen;
  for (const auto& word : other_names()) EXPECT_TRUE(seen.insert(word).second) << word;
  for (const auto& word : other_names()) EXPECT_EQ(registry.find(word), nullptr) << word;
}

}  // namespace
}  // namespace hysteron
