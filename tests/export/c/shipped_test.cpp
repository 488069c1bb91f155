// The code of the shipped compensators and controllers, held against the engine bit by bit.
#include <gtest/gtest.h>

#include "tests/export/c/in_c.h"

namespace hysteron {
namespace {

using process::Folder;
using process::Outcome;

const std::string diagrams = HYSTERON_SOURCE_DIR "/diagrams/";

struct Shipped {
  std::string name, file;
  std::vector<std::string> words;
};
void PrintTo(const Shipped& s, std::ostream* out) { *out << s.name; }

/// The compensators and controllers of chapters 2 and 5, taken out of their loops.
std::vector<Shipped> controllers() {
  std::vector<Shipped> list;
  const auto add = [&](const std::string& name, const std::string& file, std::vector<std::string> words) {
    list.push_back({name, file, std::move(words)});
  };
  for (const std::string law : {"bouc_wen", "jiles_atherton", "prandtl_ishlinskii"}) {
    const std::string choice = "compensator=" + law;
    for (const std::string file : {"compensator", "feedforward", "feedforward_fitted"})
      add(file + "_" + law, "chapter2/" + file + ".json",
          {"--choose", choice, "--from", "reference", "--to", "compensator", "--rate", "10 kHz"});
    add("feedback_continuous_" + law, "chapter2/feedback_continuous.json",
        {"--choose", choice, "--from", "reference", "--from", "position", "--to", "drive", "--rate", "10 kHz"});
    for (const std::string controller : {"first", "second"})
      add("feedback_sampled_" + law + "_" + controller, "chapter2/feedback_sampled.json",
          {"--choose", choice, "--choose", "controller=" + controller, "--from", "command", "--from", "measured",
           "--to", "converter"});
  }
  add("feedback_sampled_none", "chapter2/feedback_sampled.json",
      {"--from", "command", "--from", "measured", "--to", "drive"});
  add("feedback_series", "chapter2/feedback_series.json",
      {"--from", "command", "--from", "sensor", "--to", "compensator"});
  add("compensation", "chapter5/compensation.json", {"--from", "wanted", "--from", "assumed", "--to", "inverse"});
  add("tapi_inverse", "chapter5/tapi_inverse.json", {"--from", "wanted", "--from", "oven", "--to", "inverse"});
  for (const std::string axes : {"coupled", "single"})
    add("fabry_perot_" + axes, "chapter5/fabry_perot.json",
        {"--choose", "compensator=" + axes, "--from", "directions", "--to", "compensator"});
  return list;
}

class ControllerInC : public testing::TestWithParam<Shipped> {};

TEST_P(ControllerInC, HasTheBitsOfTheEngine) {
  const Folder folder;
  std::vector<std::string> words{diagrams + GetParam().file};
  words.insert(words.end(), GetParam().words.begin(), GetParam().words.end());
  const Outcome outcome = in_c::exported(folder, words);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Outcome run = in_c::tried(folder);
  EXPECT_EQ(run.code, 0) << run.err << run.out;
  EXPECT_NE(run.out.find(std::string("1000 ") + in_c::same_bits), std::string::npos) << run.out << run.err;
}

INSTANTIATE_TEST_SUITE_P(All, ControllerInC, testing::ValuesIn(controllers()),
                         [](const auto& made) { return made.param.name; });

}  // namespace
}  // namespace hysteron
