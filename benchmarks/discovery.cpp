// Answers a folder of cases with hidden effects (layout: README of the set; no answers needed): builds each base
// diagram, discovers what is missing, writes the answers that the set's scoring program reads, and tells what it cost.
//
//   discovery FOLDER RESULTS [--only 003,004] [--jobs 1] [--threads 2] [--seconds 45] [--unstated] [--tell]
//   [--progress] [--looser 1]
//
// --looser: candidates are simulated so many times looser: no answer may hang on it.
// --unstated: the data set does not say how noisy the sensor is.
// Each case runs in a process of its own: one that fails costs that case only.
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "benchmarks/hidden_answer.h"
#include "blocks/register_all.h"
#include "discover/effects/all.h"
#include "discover/selection/discover.h"
#include "engine/diagram/error.h"
#include "io/files/atomic_file.h"

namespace {

using namespace hysteron;
using Clock = std::chrono::steady_clock;

struct Wish {
  std::string folder, results;
  std::set<std::string> only;
  int jobs = 1;     ///< cases at once
  int threads = 2;  ///< of one case
  /// Of CPU, so that a busy machine gives the same answers: then a case ends, on two cores within thirty seconds of
  /// the clock; 0 = never.
  double seconds = 45;
  bool tell = false;      ///< everything that was tried
  bool progress = false;  ///< what is being tried, and the CPU seconds until then
  double looser = 1;      ///< see DiscoverOptions
  Noise noise = Noise::stated;
};

double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// What was tried, one line each: for people who want to know why.
std::string everything(const Discovery& d) {
  std::string text;
  for (const auto& c : d.candidates)
    text += fmt::format("\n  {}{} {} at {} ({}): p {}, train {:.1f}, validate {:.1f}, score {:.1f}, {} runs; {}; {}",
                        c.claimed ? "*" : " ", c.step, c.effect, c.place, c.law, c.parameters, c.fall_train,
                        c.fall_validate, c.score, c.model_runs, c.summary, c.reason);
  for (const auto& r : d.refused) text += fmt::format("\n   refused {} at {}: {}", r.effect, r.place, r.reason);
  for (const auto& s : d.steps)
    for (const auto& t : s.ties) text += fmt::format("\n   as good: {}", t.effect);
  for (const auto& r : d.data_remarks) text += "\n   " + r;
  if (d.structure) text += "\n   structure: " + d.structure->sentence;
  for (std::size_t i = 0; i < d.final_error.recordings.size(); ++i) {
    const auto& e = d.final_error.recordings[i];
    const double rows = static_cast<double>(e.rows);
    text += fmt::format("\n   {} {} chi2/N {:.3f}, before {:.3f}", e.recording, e.output, e.chi2 / rows,
                        d.base.recordings[i].chi2 / rows);
  }
  return text;
}

/// [s] that this process, one case, has computed so far.
double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// One case, from its folder to its answer. Returns what is told of it.
std::string answer_case(const std::filesystem::path& folder, const Wish& wish) {
  const HiddenCase hidden = read_hidden_case(folder.string(), wish.noise);
  const std::string file = (std::filesystem::path(wish.results) / (hidden.id + ".data.json")).string();
  write_file(file, hidden.data_text + "\n");
  const DataSet data = read_dataset(file, {std::filesystem::absolute(folder).lexically_normal().string()});
  const Effects effects = all_effects();
  DiscoverOptions options;
  for (const auto& name : hidden_effect_names())
    if (effects.find(name) != nullptr) options.only.push_back(name);
  if (wish.seconds > 0) {
    options.spent = [&] { return cpu_seconds() / (DiscoverOptions::to_search * wish.seconds); };
    options.stop = [&] { return cpu_seconds() > wish.seconds; };
  }
  options.threads = wish.threads;
  options.looser = wish.looser;
  options.free_paths = hidden.free_paths;
  options.numbers_are_exact = hidden.numbers_are_exact;
  if (wish.progress)
    options.progress = [&](const std::string& what, double) {
      fmt::print(stderr, "{} {:7.2f}  {}\n", hidden.id, cpu_seconds(), what);
    };
  const Discovery found = discover(hidden.diagram, data, all_blocks(), effects, options);
  write_hidden_answer(hidden, data, found, cpu_seconds(), wish.results);
  const std::string late = found.broken_off ? ", stopped by its time limit" : "";
  return fmt::format("{} runs{}; {}{}", found.model_runs, late, found.headline, wish.tell ? everything(found) : "");
}

/// In a process of its own.
int child(const std::filesystem::path& folder, const Wish& wish) {
  const auto start = Clock::now();
  std::string told;
  int code = 0;
  try {
    told = answer_case(folder, wish);
  } catch (const std::exception& e) {
    told = std::string("failed: ") + e.what();
    code = 1;
  }
  fmt::print("{} {:6.1f} s  {}\n", folder.filename().string(), since(start), told);
  std::fflush(stdout);
  return code;
}

struct Cost {
  std::string id;
  double cpu = 0, wall = 0;
  bool ok = false;
};

class Pool {
 public:
  explicit Pool(const Wish& wish) : wish_(wish) {}

  void run(const std::filesystem::path& folder) {
    if (static_cast<int>(running_.size()) >= std::max(1, wish_.jobs)) wait_for_one();
    std::fflush(stdout);
    const pid_t pid = fork();
    if (pid == 0) _exit(child(folder, wish_));
    if (pid < 0) {
      costs_.push_back({folder.filename().string()});
      return;
    }
    running_[pid] = {folder.filename().string(), Clock::now()};
  }

  std::vector<Cost> finish() {
    while (!running_.empty()) wait_for_one();
    return costs_;
  }

 private:
  void wait_for_one() {
    int status = 0;
    rusage usage{};
    const pid_t pid = wait4(-1, &status, 0, &usage);
    const auto found = running_.find(pid);
    if (found == running_.end()) return;
    const auto seconds = [](const timeval& t) {
      return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    Cost c{found->second.first, seconds(usage.ru_utime) + seconds(usage.ru_stime), since(found->second.second),
           WIFEXITED(status) && WEXITSTATUS(status) == 0};
    if (WIFSIGNALED(status)) fmt::print("{} crashed with signal {}\n", c.id, WTERMSIG(status));
    costs_.push_back(c);
    running_.erase(found);
  }

  const Wish& wish_;
  std::map<pid_t, std::pair<std::string, Clock::time_point>> running_;
  std::vector<Cost> costs_;
};

void table(std::vector<Cost> costs) {
  if (costs.empty()) return;
  const auto row = [&](const char* what, double Cost::*of) {
    std::sort(costs.begin(), costs.end(), [&](const Cost& a, const Cost& b) { return a.*of < b.*of; });
    double sum = 0;
    for (const auto& c : costs) sum += c.*of;
    fmt::print("{:<14} median {:6.2f}   worst {:6.2f} (case {})   all {:8.1f}\n", what, costs[costs.size() / 2].*of,
               costs.back().*of, costs.back().id, sum);
  };
  fmt::print("\n{} cases, {} failed\n", costs.size(),
             std::count_if(costs.begin(), costs.end(), [](const Cost& c) { return !c.ok; }));
  row("CPU seconds", &Cost::cpu);
  row("wall seconds", &Cost::wall);
}

std::optional<Wish> read_wish(int argc, char** argv) {
  Wish wish;
  std::vector<std::string> places;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const auto next = [&] { return i + 1 < argc ? std::string(argv[++i]) : std::string(); };
    if (word == "--only") {
      std::stringstream list(next());
      for (std::string id; std::getline(list, id, ',');) wish.only.insert(id);
    } else if (word == "--jobs") {
      wish.jobs = std::atoi(next().c_str());
    } else if (word == "--threads") {
      wish.threads = std::atoi(next().c_str());
    } else if (word == "--seconds") {
      wish.seconds = std::atof(next().c_str());
    } else if (word == "--looser") {
      wish.looser = std::atof(next().c_str());
    } else if (word == "--unstated") {
      wish.noise = Noise::unstated;
    } else if (word == "--tell") {
      wish.tell = true;
    } else if (word == "--progress") {
      wish.progress = true;
    } else {
      places.push_back(word);
    }
  }
  if (places.size() != 2 || !std::filesystem::is_directory(places[0])) return std::nullopt;
  wish.folder = places[0];
  wish.results = places[1];
  return wish;
}

}  // namespace

int main(int argc, char** argv) {
  const auto wish = read_wish(argc, argv);
  if (!wish) {
    fmt::print(stderr,
               "discovery FOLDER RESULTS [--only 003,004] [--jobs 1] [--threads 2] [--seconds 45] [--unstated] "
               "[--tell] [--progress] [--looser 1]\n"
               "FOLDER holds one folder with task.json and recordings per case; answers go to RESULTS.\n");
    return 2;
  }
  std::filesystem::create_directories(wish->results);
  std::vector<std::filesystem::path> cases;
  for (const auto& entry : std::filesystem::directory_iterator(wish->folder))
    if (std::filesystem::exists(entry.path() / "task.json") &&
        (wish->only.empty() || wish->only.count(entry.path().filename().string()) > 0))
      cases.push_back(entry.path());
  std::sort(cases.begin(), cases.end());
  Pool pool(*wish);
  for (const auto& c : cases) pool.run(c);
  const auto costs = pool.finish();
  table(costs);
  return std::all_of(costs.begin(), costs.end(), [](const Cost& c) { return c.ok; }) ? 0 : 1;
}
