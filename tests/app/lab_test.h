// Decides what a test of a verb has at hand: a small laboratory (lab.h) in a folder of its own.
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/app/hysteron_process.h"
#include "tests/app/lab.h"

namespace hysteron {

class LabTest : public testing::Test {
 protected:
  void SetUp() override { lab::furnish(folder_); }
  /// Data set with sensor noise of 5 nm, and its two recordings: seeds `seed` and the next, u behind a lag of `tau`
  /// [s].
  void record(unsigned seed, double tau = 0) const {
    std::string data = lab::dataset();
    data.replace(data.find("1 nm"), 4, "5 nm");
    folder_.write("dataset.json", data);
    folder_.write("a.csv", lab::noisy_recording(seed, tau));
    folder_.write("b.csv", lab::noisy_recording(seed + 1, tau));
  }
  nlohmann::json result(const std::string& folder) const {
    return nlohmann::json::parse(folder_.read(folder + "/result.json"));
  }
  const process::Folder folder_;
};

}  // namespace hysteron
