// Cases of hidden effects: from task.json to a diagram, and from a discovery to the answer.
#include "benchmarks/hidden_case.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "benchmarks/hidden_answer.h"
#include "blocks/register_all.h"
#include "discover/effects/all.h"
#include "discover/placement/rows.h"
#include "engine/diagram/error.h"
#include "io/files/atomic_file.h"
#include "tests/discover/synthetic.h"
#include "tests/io/temporary_folder.h"

namespace hysteron {
namespace {

using namespace testing;
using nlohmann::json;

class HiddenCases : public ::testing::Test {
 protected:
  HiddenCases() { std::filesystem::create_directories(folder_ / "results"); }

  void write_task(const std::string& base, const json& parameters, const std::vector<std::string>& outputs,
                  const json& free = json::array()) {
    json task{{"id", "042"}, {"base", base}, {"base_parameters", parameters}, {"outputs", outputs}};
    if (!free.empty()) task["base_parameters_free"] = free;
    task["sensor"] = {{"lsb", 1e-4}, {"datasheet_noise_rms", 1e-3}};
    task["files"] = {{{"file", "01.csv"}, {"role", "train"}, {"start_h", 0.5}, {"cycles_before", 0}},
                     {{"file", "02.csv"}, {"role", "validate"}, {"start_h", 1.5}, {"cycles_before", 20}}};
    write_file((folder_ / "task.json").string(), task.dump());
  }
  /// What the base model says in the end with all inputs constant [SI].
  std::vector<double> settled(const std::vector<double>& inputs, double after) const {
    const auto program = compile(read_hidden_case(folder_.string()).diagram, registry_);
    std::vector<SeriesPointer> series;
    for (const double level : inputs)
      series.push_back(std::make_shared<const Series>(Series{{0.0, after}, {level, level}, Between::linear}));
    std::vector<double> last;
    for (const auto& y : simulate_rows(program, series, {0.0, after}, program->output_signals, true))
      last.push_back(y.back());
    return last;
  }
  TemporaryFolder temporary_;
  const std::filesystem::path folder_ = temporary_.path();
  Registry registry_ = all_blocks();
};

TEST_F(HiddenCases, AMassOnASpringSettlesAtForceOverStiffness) {
  write_task("B4",
             {{"mass_kg", 2.0},
              {"damping_Ns_per_m", 30.0},
              {"stiffness_N_per_m", 4e4},
              {"force_per_volt_N", 0.1},
              {"offset_um", 0.3}},
             {"y [um]"});
  EXPECT_NEAR(settled({2.0}, 10.0).front(), 2.0 * 0.1 / 4e4 + 0.3e-6, 1e-15);
}

TEST_F(HiddenCases, AHeatedMassSettlesAboveAmbientByPowerTimesResistance) {
  write_task("B5",
             {{"C1_J_per_K", 20.0},
              {"C2_J_per_K", 60.0},
              {"R12_K_per_W", 1.5},
              {"R2a_K_per_W", 4.0},
              {"power_per_volt_W", 0.8}},
             {"T [degC]"});
  EXPECT_NEAR(settled({5.0, 293.15}, 1e5).front(), 293.15 + 5 * 0.8 * 4, 1e-6);
}

TEST_F(HiddenCases, WhatTheUserKnowsRoughlyIsFree) {
  json task = {{"thresholds_V", {0.0, 0.5}}, {"weights_um_per_V", {1.0, 0.2}}, {"offset_um", 0.0}};
  write_task("B2", task, {"y [um]"}, {"weights_um_per_V"});
  EXPECT_EQ(read_hidden_case(folder_.string()).free_paths, (std::vector<std::string>{"stage.weights"}));
  EXPECT_TRUE(read_hidden_case(folder_.string()).numbers_are_exact) << "as the README of the set says";
  write_task("B2", task, {"y [um]"}, {"offset_um"});
  EXPECT_THROW(read_hidden_case(folder_.string()), Error);
}

TEST_F(HiddenCases, AFolderWithoutTaskAndABaseThatNobodyKnowsAreRefused) {
  EXPECT_THROW(read_hidden_case((folder_ / "nothing").string()), Error);
  write_task("B9", json::object(), {"y [um]"});
  EXPECT_THROW(read_hidden_case(folder_.string()), Error);
}

TEST_F(HiddenCases, TheAnswerNamesTheEffectAndItsPredictedRowsHaveTheStatedError) {
  write_task("B2", {{"thresholds_V", {0.0, 0.5}}, {"weights_um_per_V", {1.0, 0.2}}, {"offset_um", 0.0}}, {"y [um]"});
  double seed = 0;
  for (const char* file : {"01.csv", "02.csv"}) {
    const auto t = rows(400, 0.01);
    const auto u = several_sines(t, 2, {0.4, 1.1 + 0.3 * seed});
    const auto e = noise(t.size(), 1e-3, 0, static_cast<std::uint64_t>(++seed));
    std::string text = "t [s],u [V],y [um],T [degC]\n";
    double play = 0;
    for (std::size_t k = 0; k < t.size(); ++k) {
      play = std::max(u[k] - 0.5, std::min(u[k], play));
      text += fmt::format("{},{},{},22\n", t[k], u[k], 1.02 * (u[k] + 0.2 * play) + 0.05 + e[k]);
    }
    write_file((folder_ / file).string(), text);
  }
  const HiddenCase hidden = read_hidden_case(folder_.string());
  write_file((folder_ / "data.json").string(), hidden.data_text);
  const DataSet data = read_dataset((folder_ / "data.json").string(), {folder_.string()});
  DiscoverOptions options;
  options.max_steps = 1;
  options.only = {"calibration", "dead_time"};
  const Discovery found = discover(hidden.diagram, data, registry_, all_effects(), options);
  const std::string results = (folder_ / "results").string();
  write_hidden_answer(hidden, data, found, 1.5, results);
  const json answer = json::parse(read_file(results + "/042.json"));
  EXPECT_EQ(answer.at("verdict"), "missing_effect");
  EXPECT_EQ(answer.at("effects").at(0), "calibration");
  EXPECT_EQ(answer.at("claimed"), 1);
  EXPECT_EQ(answer.at("seconds"), 1.5);
  // Gain 2 % of about 1 um and offset 0.05 um before; noise 1 nm after.
  EXPECT_GT(answer.at("validation_rms_before").get<double>(), 0.04);
  EXPECT_NEAR(answer.at("validation_rms_after").get<double>(), 1e-3, 2e-4);
  EXPECT_TRUE(std::filesystem::exists(results + "/042.diagram.json"));
  const std::string predicted = read_file(results + "/042.predicted/02.csv");
  EXPECT_EQ(predicted.substr(0, predicted.find('\n')), "t [s],y [um]");
  EXPECT_EQ(std::count(predicted.begin(), predicted.end(), '\n'), 401);
}

}  // namespace
}  // namespace hysteron
