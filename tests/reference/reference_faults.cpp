// reference_faults FIRST LAST FOLDER [FILE...]: tries the random diagrams of these seeds, writes those on which program
// and reference do not agree into FOLDER/SEED/, and prints one line for each and a count of all.
// reference_faults FILE: judges one diagram.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "tests/reference/judge.h"
#include "tests/reference/random_diagram.h"

namespace {

namespace fs = std::filesystem;

void write(const reference::RandomDiagram& diagram, const fs::path& folder) {
  fs::create_directories(folder);
  std::ofstream(folder / "diagram.json") << diagram.text;
  for (const auto& [name, text] : diagram.files) std::ofstream(folder / name) << text;
}

void print(const std::string& name, const reference::Judgement& j) {
  std::string words = j.words;
  for (auto& c : words)
    if (c == '\n') c = ' ';
  std::printf("%s: %s, %s, %.3g tolerances at %.6g s. %s\n", name.c_str(), reference::verdict_name(j.verdict),
              j.signal.c_str(), j.error, j.t, words.c_str());
  std::fflush(stdout);
}

}  // namespace

int main(int count, char** words) {
  if (count == 2) {
    print(words[1], reference::judge(words[1]));
    return 0;
  }
  if (count != 4) {
    std::puts("reference_faults FIRST LAST FOLDER | reference_faults FILE");
    return 1;
  }
  std::map<std::string, int> counts;
  for (long seed = std::stol(words[1]); seed <= std::stol(words[2]); ++seed) {
    const fs::path folder = fs::path(words[3]) / std::to_string(seed);
    write(reference::random_diagram(static_cast<std::uint64_t>(seed)), folder);
    const auto judgement = reference::judge((folder / "diagram.json").string());
    ++counts[reference::verdict_name(judgement.verdict)];
    if (judgement.verdict == reference::Verdict::agrees)
      fs::remove_all(folder);
    else
      print((folder / "diagram.json").string(), judgement);
  }
  for (const auto& [name, n] : counts) std::printf("%s: %d\n", name.c_str(), n);
  return counts["wrong"] > 0 ? 3 : 0;
}
