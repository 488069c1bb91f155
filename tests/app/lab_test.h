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
  nlohmann::json result(const std::string& folder) const {
    return nlohmann::json::parse(folder_.read(folder + "/result.json"));
  }
  const process::Folder folder_;
};

}  // namespace hysteron
