// The file of an experiment is read back by the reader of recordings as what was simulated, and says what to measure.
#include "report/pages/drive_file.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

#include "io/data/recording_file.h"

namespace hysteron {
namespace {

Experiment experiment() {
  Experiment e;
  e.word = "step_hold";
  e.text = "move u, hold the other inputs: levels 0 V, 1 V, 3 s each";
  e.between = "creep and backlash";
  e.separation = 12.345;
  DriveRows rows;
  rows.t = {0, 1e-3, 1.0 / 3, 2, 6};
  rows.inputs = {{"u", parse_unit("mV"), {0, 0.1, 0.3, 1, 1.0 / 7}, true},
                 {"room", parse_unit("degC"), std::vector<double>(5, 294.15), false}};
  rows.shortest_step = 1e-3;
  rows.outputs = {"y", "z"};
  rows.besides = {"cycles_before"};
  e.drive = std::make_shared<const DriveRows>(rows);
  return e;
}

TEST(DriveFile, IsReadBackAsTheRowsThatWereSimulated) {
  const Experiment e = experiment();
  const std::string file = ::testing::TempDir() + "hysteron_drive_file_test.csv";
  std::ofstream(file) << drive_file_text(e);
  const RecordingFile read = read_recording_file(file, 1);
  std::remove(file.c_str());
  // Digits are those of a double; units cost a rounding.
  ASSERT_EQ(read.t.size(), e.drive->t.size());
  for (std::size_t k = 0; k < read.t.size(); ++k) EXPECT_DOUBLE_EQ(read.t[k], e.drive->t[k]) << k;
  for (const auto& input : e.drive->inputs) {
    const auto& column = read.columns.at(input.name);
    ASSERT_EQ(column.size(), input.values.size());
    for (std::size_t k = 0; k < column.size(); ++k) EXPECT_NEAR(column[k], input.values[k], 1e-12) << k;
    EXPECT_EQ(read.units.at(input.name).text, input.unit.text);
  }
}

TEST(DriveFile, SaysWhatMovesWhatIsHeldAndWhatToMeasure) {
  const std::string text = drive_file_text(experiment());
  EXPECT_TRUE(text.starts_with(drive_file_head)) << "a file of ours is known by that";
  for (const char* line :
       {"# An experiment that hysteron asks for, to tell creep and backlash apart\n",
        "# step_hold: move u, hold the other inputs: levels 0 V, 1 V, 3 s each\n",
        "# Moves: u, along straight lines from row to row\n", "# Held: room\n", "to be recorded: cycles_before\n",
        "# Measure: y, z, for 6 s, in these rows or every 1 ms\n", "12.3 times the noise"})
    EXPECT_NE(text.find(line), std::string::npos) << line << text;
}

TEST(DriveFile, WhatMovesFasterThanItWasRecordedIsTold) {
  Experiment e = experiment();
  DriveRows rows = *e.drive;
  rows.inputs[0].fastest = 0.02;
  rows.inputs[0].recorded = 0.02;
  e.drive = std::make_shared<const DriveRows>(rows);
  EXPECT_TRUE(faster_than_recorded(e).empty());
  rows.inputs[0].recorded = 0.005;
  e.drive = std::make_shared<const DriveRows>(rows);
  EXPECT_EQ(faster_than_recorded(e), std::vector<std::string>{"u moves by up to 20 mV/s, in the recordings by 5"});
  EXPECT_NE(drive_file_text(e).find("# Faster than recorded: u moves by up to 20 mV/s"), std::string::npos);
}

TEST(DriveFile, ASecondSensorIsAskedFor) {
  Experiment e = experiment();
  e.word = "reference_sensor";
  EXPECT_EQ(what_to_measure(e),
            "y, z and the same by a second, independent sensor, for 6 s, in these rows or every 1 ms");
}

}  // namespace
}  // namespace hysteron
