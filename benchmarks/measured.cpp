// Discovers what simple models of measured devices lack, and prints what was named and how far the error fell on
// recordings that were not used for the fit. Models and data sets: benchmarks/measured/; the recordings are used where
// they lie (../shared/measured beside the project) and are never copied.
//
//   measured [FOLDER] [--only silverbox,heater] [--seconds 300] [--tell] [--progress]
//
// FOLDER: another folder of models (NAME.json) and data sets (NAME.data.json), all of which are taken.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "blocks/register_all.h"
#include "discover/effects/all.h"
#include "discover/selection/discover.h"
#include "engine/diagram/error.h"
#include "engine/program/program.h"
#include "fit/model/model.h"
#include "fit/model/noise.h"
#include "fit/model/score.h"
#include "io/diagram/diagram_file.h"

namespace {

using namespace hysteron;

const std::string declarations = HYSTERON_SOURCE_DIR "/benchmarks/measured/";
const std::string recordings = HYSTERON_SHARED_DIR "/measured";

struct Device {
  std::string name, diagram, data;
};

std::vector<Device> devices() {
  std::vector<Device> list;
  for (const char* name : {"piezo_stack", "piezo_stack_more", "silverbox", "silverbox_held", "mr_damper_a",
                           "mr_damper_b", "mr_damper_v", "heater", "two_mass"}) {
    std::string diagram = declarations + name + ".json";
    if (!std::filesystem::exists(diagram)) {  // another data set of the same model
      const std::string all = name;
      diagram = declarations + all.substr(0, all.rfind('_')) + ".json";
    }
    list.push_back({name, diagram, declarations + name + ".data.json"});
  }
  return list;
}

/// Every data set of a folder that has a model of its name, in the order of their names.
std::vector<Device> devices_of(const std::string& folder) {
  std::vector<Device> list;
  const std::string end = ".data.json";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string file = entry.path().filename().string();
    if (!file.ends_with(end)) continue;
    const std::string name = file.substr(0, file.size() - end.size());
    const auto diagram = entry.path().parent_path() / (name + ".json");
    if (std::filesystem::exists(diagram)) list.push_back({name, diagram.string(), entry.path().string()});
  }
  std::sort(list.begin(), list.end(), [](const Device& a, const Device& b) { return a.name < b.name; });
  return list;
}

struct Wish {
  std::string folder;  ///< of models and data sets; the measured devices if empty
  std::vector<std::string> only;
  double seconds = 600;  ///< after so many the search ends with what it has found
  bool tell = false;
  bool progress = false;  ///< what is being tried, and the CPU seconds until then
};

Wish wish_of(int count, char** words) {
  Wish wish;
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    const auto next = [&] { return i + 1 < count ? std::string(words[++i]) : std::string(); };
    if (word == "--tell") {
      wish.tell = true;
    } else if (word == "--progress") {
      wish.progress = true;
    } else if (word == "--seconds") {
      wish.seconds = std::atof(next().c_str());
    } else if (word == "--only") {
      std::istringstream names(next());
      for (std::string name; std::getline(names, name, ',');) wish.only.push_back(name);
    } else if (!word.starts_with("-") && std::filesystem::is_directory(word)) {
      wish.folder = word;
    } else {
      fmt::print(stderr, "measured [FOLDER] [--only NAME,NAME] [--seconds 300] [--tell] [--progress]\n");
      std::exit(2);
    }
  }
  return wish;
}

double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Error of a diagram on each recording that it was not fitted to, each output: rms [SI] and share of the deviation.
struct Figure {
  std::string of;
  double rms = 0, nrmse = 0;
};

std::vector<Figure> figures(const Diagram& diagram, const DataSet& data, const Registry& registry) {
  DataModelOptions options;
  options.max_substeps = 1024;
  DataModel model(compile(diagram, registry), std::make_shared<const DataSet>(data), options);
  std::vector<int> judged;
  for (int r = 0; r < model.n_recordings(); ++r)
    if (model.recording(r).role != Role::train) judged.push_back(r);
  Prediction p = model.predict({}, judged);
  if (!p.ok) throw std::runtime_error(p.error);
  add_zeros(model, Judge(model, noise_before_fit(model)), p);
  std::vector<Figure> list;
  for (const int r : judged)
    for (int o = 0; o < static_cast<int>(model.outputs().size()); ++o) {
      const Rows& y = model.measured(r, o);
      double mean = 0, squares = 0;
      for (const double v : y) mean += v / static_cast<double>(y.size());
      for (const double v : y) squares += (v - mean) * (v - mean) / static_cast<double>(y.size());
      Figure f;
      f.of = fmt::format("{} {} {}", to_text(model.recording(r).role),
                         std::filesystem::path(model.recording(r).name).filename().string(),
                         model.outputs()[static_cast<std::size_t>(o)]);
      f.rms = rms(model, p, std::span<const int>(&r, 1), o);
      f.nrmse = f.rms / std::sqrt(squares);
      list.push_back(std::move(f));
    }
  return list;
}

std::string names_of(const Discovery& d) {
  std::vector<std::string> names;
  for (const auto& step : d.steps) {
    std::string name = step.winner.effect + " at " + step.winner.place;
    for (const auto& other : step.winner.same_effects) name += " = " + other;
    for (const auto& tie : step.ties) name += " or " + tie.effect + " at " + tie.place;
    names.push_back(std::move(name));
  }
  return fmt::format("{}", fmt::join(names, ", then "));
}

void tell(const Discovery& d) {
  for (const auto& c : d.candidates)
    fmt::print("  {}{} {} at {} ({}): p {}, train {:.1f}, validate {:.1f}, score {:.1f}, share {:.2f}; {}; {}\n",
               c.claimed ? "*" : " ", c.step, c.effect, c.place, c.law, c.parameters, c.fall_train, c.fall_validate,
               c.score, c.share_removed, c.summary, c.reason);
  for (const auto& r : d.refused) fmt::print("   refused {} at {}: {}\n", r.effect, r.place, r.reason);
}

void look_at(const Device& device, const Wish& wish, const Registry& registry, const Effects& effects) {
  const Diagram diagram = read_diagram(device.diagram);
  const DataSet data = read_dataset(device.data, {HYSTERON_SHARED_DIR});
  const auto start = std::chrono::steady_clock::now();
  const double cpu = cpu_seconds();
  DiscoverOptions options;
  const auto spent = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / wish.seconds;
  };
  options.spent = [&] { return spent() / DiscoverOptions::to_search; };
  options.stop = [&] { return spent() > 1; };
  if (wish.progress)
    options.progress = [&](const std::string& what, double) {
      fmt::print(stderr, "{:<16} {:7.2f}  {}\n", device.name, cpu_seconds() - cpu, what);
    };
  const Discovery d = discover(diagram, data, registry, effects, options);
  fmt::print("{}: {}{}\n  {}\n  {:.1f} s CPU, {} simulations\n", device.name, to_text(d.verdict),
             d.broken_off ? " (stopped by its time)" : "", d.steps.empty() ? d.headline : names_of(d),
             cpu_seconds() - cpu, d.model_runs);
  const auto before = figures(d.base_diagram, as_found(data, d), registry),
             after = figures(d.final_diagram, as_found(data, d), registry);
  for (std::size_t i = 0; i < before.size(); ++i)
    fmt::print("  {:<48} {:6.2f} % -> {:5.2f} %   rms {:.4g} -> {:.4g}\n", before[i].of, 100 * before[i].nrmse,
               100 * after[i].nrmse, before[i].rms, after[i].rms);
  for (const auto& warning : d.warnings) fmt::print("  note: {}\n", warning);
  if (wish.tell) tell(d);
  std::fflush(stdout);
}

}  // namespace

int main(int count, char** words) {
  const Wish wish = wish_of(count, words);
  if (wish.folder.empty() && !std::filesystem::is_directory(recordings)) {
    fmt::print("skipped: {} is not there\n", recordings);
    return 0;
  }
  const Registry registry = all_blocks();
  const Effects effects = all_effects();
  int failed = 0;
  for (const auto& device : wish.folder.empty() ? devices() : devices_of(wish.folder)) {
    if (!wish.only.empty() && std::find(wish.only.begin(), wish.only.end(), device.name) == wish.only.end()) continue;
    try {
      look_at(device, wish, registry, effects);
    } catch (const std::exception& e) {
      fmt::print("{}: failed: {}\n", device.name, e.what());
      ++failed;
    }
  }
  return failed == 0 ? 0 : 3;
}
