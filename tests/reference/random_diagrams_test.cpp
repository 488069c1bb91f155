// Random diagrams, on which the program agrees with the reference or says why it does not answer.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/reference/judge.h"
#include "tests/reference/random_diagram.h"

namespace reference {
namespace {

namespace fs = std::filesystem;

std::string written(std::uint64_t seed, const fs::path& folder) {
  const RandomDiagram diagram = random_diagram(seed);
  fs::create_directories(folder);
  std::ofstream(folder / "diagram.json") << diagram.text;
  for (const auto& [name, text] : diagram.files) std::ofstream(folder / name) << text;
  return (folder / "diagram.json").string();
}

void try_seeds(std::uint64_t first, std::uint64_t last, const std::string& name) {
  const fs::path folder = fs::path(testing::TempDir()) / name;
  int answered = 0;
  for (std::uint64_t seed = first; seed <= last; ++seed) {
    const Judgement j = judge(written(seed, folder));
    answered += j.verdict == Verdict::agrees;
    EXPECT_NE(j.verdict, Verdict::wrong) << "seed " << seed << ": " << j.signal << " is " << j.error
                                         << " tolerances off at " << j.t << " s";
    fs::remove_all(folder);
  }
  // What is refused, or not known to the reference, is the exception: else nothing would be tried.
  EXPECT_GT(answered, 0.9 * static_cast<double>(last - first + 1));
}

TEST(RandomDiagrams, AgreeWithTheReference) { try_seeds(1, 60, "random_diagrams"); }

}  // namespace
}  // namespace reference
