#include "app/study/study_shards.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <filesystem>
#include <mutex>
#include <string_view>
#include <thread>

#include "app/cli/interrupt.h"
#include "engine/diagram/error.h"
#include "engine/diagram/stop.h"
#include "io/files/atomic_file.h"
#include "io/files/folder_lock.h"
#include "io/files/sealed_file.h"
#include "report/pages/numbers.h"

namespace hysteron {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t shard_format = 1;
constexpr char content_of_shard[] = "shard of a study";
constexpr char marker[] = "shards/study.txt";

std::vector<std::int64_t> numbers(const std::vector<std::uint64_t>& list) { return {list.begin(), list.end()}; }
std::vector<std::uint64_t> counts_of(const std::vector<std::int64_t>& list) { return {list.begin(), list.end()}; }

[[noreturn]] void cannot_write(const std::string& folder, const std::error_code& code) {
  fail("cannot_write", folder, fmt::format("the folder cannot be made: {}", code.message()),
       "choose another folder with -o");
}

/// Empty, or what a study leaves that is killed before it has said whose the folder is.
bool hardly_begun(const fs::path& folder) {
  std::error_code code;
  if (is_free(folder)) return true;
  for (const auto& entry : fs::directory_iterator(folder, code))
    if (entry.path().filename() != unfinished_folder &&
        (entry.path().filename() != "shards" || !entry.is_directory(code)))
      return false;
  for (const auto& entry : fs::directory_iterator(folder / "shards", code))
    if (!entry.path().filename().string().starts_with("study.txt.")) return false;
  return true;
}

/// "3-of-16.h5": the name of a shard, of however many?
bool is_shard_name(std::string_view name) {
  const auto number = [&] {
    const auto end = std::min(name.find_first_not_of("0123456789"), name.size());
    name.remove_prefix(end);
    return end > 0;
  };
  const auto word = [&](std::string_view text) {
    const bool begins = name.starts_with(text);
    if (begins) name.remove_prefix(text.size());
    return begins;
  };
  return number() && word("-of-") && number() && name == ".h5";
}

/// True for what may be left of a file of ours whose process was killed, by this version or an earlier one.
bool may_be_left_over(const std::string& name) {
  const std::string file = name.substr(0, name.find(unfinished_prefix("")));
  if (file.size() < name.size())
    return file == "study.h5" || file == "study.csv" || file == "study.txt" || is_shard_name(file);
  for (const std::string own : {"study.txt", "result.json", "result.schema.json", "report.html"})
    if (name.starts_with(own + ".") && name.size() == own.size() + 7) return true;
  return false;
}

/// Shards that threads take one after the other, and what they have done so far.
class ShardWork {
 public:
  ShardWork(const StudyFolder& folder, const std::vector<int>& shards) : folder_(folder), shards_(shards) {}

  void take_all() {
    try {
      for (std::size_t i = next_++; i < shards_.size() && !stop_; i = next_++)
        if (compute(shards_[i])) ++finished_;
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
      stop_ = true;
    }
    const std::lock_guard lock(mutex_);
    ++done_;
    changed_.notify_all();
  }

  /// Until `threads` have ended; `show` every tenth of a second.
  void wait_for(int threads, const std::function<void(const StudyProgress&)>& show) {
    std::unique_lock lock(mutex_);
    while (done_ < threads) {
      changed_.wait_for(lock, std::chrono::milliseconds(100));
      if (stop_asked()) stop_ = true;
      if (show) show({static_cast<int>(shards_.size()), static_cast<int>(finished_), draws_, accepted_});
    }
  }

  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }
  std::size_t finished() const { return finished_; }

 private:
  /// Whoever asks the thread that began the work.
  bool asked_to_stop() const { return asked_ != nullptr && (*asked_)(); }

  bool compute(int shard) try {
    StudyCounts before;
    const StopScope scope([&] { return stop_ || asked_to_stop(); });
    return folder_.compute(shard, [&](const StudyCounts& counts) {
      draws_ += counts.draws - before.draws;
      accepted_ += counts.accepted - before.accepted;
      before.draws = counts.draws;
      before.accepted = counts.accepted;
      return !stop_ && !asked_to_stop();
    });
  } catch (const Stopped&) {
    return false;
  }

  const StudyFolder& folder_;
  const std::vector<int>& shards_;
  const StopScope::Asked* const asked_ = current_stop();
  std::atomic<std::size_t> next_{0};
  std::atomic<std::size_t> finished_{0};
  std::atomic<std::uint64_t> draws_{0}, accepted_{0};
  std::atomic<bool> stop_{false};
  std::mutex mutex_;
  std::condition_variable changed_;
  std::exception_ptr failure_;
  int done_ = 0;
};

}  // namespace

std::vector<ColumnHead> study_heads(const Study& study) {
  std::vector<ColumnHead> heads{{"draw", "", "number of the draw, from 0", true}};
  if (study.keep_all) heads.push_back({"accepted", "", "1: it passed every filter", true});
  for (const auto& c : study.columns) heads.push_back({c.name, c.unit.text, c.told()});
  return heads;
}

void add_counts(const StudyCounts& counts, FileFacts& facts) {
  const auto add = [&](std::string name, FileFact fact) { facts.emplace_back(std::move(name), std::move(fact)); };
  add("draws", static_cast<std::int64_t>(counts.draws));
  add("accepted", static_cast<std::int64_t>(counts.accepted));
  add("passed", numbers(counts.passed));
  add("not_finite", numbers(counts.not_finite));
  std::vector<std::string> codes;
  std::vector<std::int64_t> failed;
  for (const auto& [code, n] : counts.failed) {
    codes.push_back(code);
    failed.push_back(static_cast<std::int64_t>(n));
  }
  add("failure_codes", fmt::format("{}", fmt::join(codes, "\n")));
  add("failed", failed);
  add("first_failure", counts.failure);
  add("first_failure_draw", static_cast<std::int64_t>(counts.failure_draw));
  add("gave_up", static_cast<std::int64_t>(counts.gave_up ? 1 : 0));
  for (std::size_t h = 0; h < counts.histograms.size(); ++h)
    add(fmt::format("histogram_{}", h + 1), numbers(counts.histograms[h]));
}

StudyCounts read_counts(const Study& study, const ColumnReader& file) {
  StudyCounts counts = StudyCounts::of(study);
  counts.draws = static_cast<std::uint64_t>(file.whole("draws"));
  counts.accepted = static_cast<std::uint64_t>(file.whole("accepted"));
  const auto list = [&](const std::string& name, std::vector<std::uint64_t>& to) {
    auto found = counts_of(file.list(name));
    found.resize(to.size());
    to = std::move(found);
  };
  list("passed", counts.passed);
  list("not_finite", counts.not_finite);
  for (std::size_t h = 0; h < counts.histograms.size(); ++h)
    list(fmt::format("histogram_{}", h + 1), counts.histograms[h]);
  const auto failed = file.list("failed");
  std::string codes = file.text("failure_codes") + "\n";
  for (std::size_t i = 0, begin = 0; i < failed.size(); ++i) {
    const auto end = codes.find('\n', begin);
    counts.failed[codes.substr(begin, end - begin)] = static_cast<std::uint64_t>(failed[i]);
    begin = end + 1;
  }
  counts.failure = file.text("first_failure");
  counts.failure_draw = static_cast<std::uint64_t>(file.whole("first_failure_draw"));
  counts.gave_up = file.whole("gave_up") != 0;
  return counts;
}

StudyFolder::StudyFolder(std::string folder, const Study& study, std::string job, int shards)
    : folder_(std::move(folder)), study_(study), job_(std::move(job)), shards_(shards) {
  while (folder_.size() > 1 && folder_.back() == '/') folder_.pop_back();
}

void StudyFolder::check() const {
  const fs::path folder(folder_);
  std::error_code code;
  if (fs::exists(folder / marker, code) || !fs::exists(folder, code)) return;
  const bool free = fs::is_directory(folder, code) && hardly_begun(folder);
  if (!free && !fs::exists(folder / marker, code))  // another process may have begun this instant
    fail("folder_in_use", folder_, "there are other files, and no study of hysteron",
         "choose another folder with -o, or empty this one");
}

bool StudyFolder::open() const {
  check();
  const fs::path folder(folder_);
  std::error_code code;
  const bool known = fs::exists(folder / marker, code);
  fs::create_directories(folder / "shards", code);
  if (code) cannot_write(folder_, code);
  const std::string text =
      fmt::format("Shards of the study {}. Each is computed anew where it belongs to another one.\n", job_);
  if (known && read_file((folder / marker).string()) == text) return false;
  write_file((folder / marker).string(), text);
  return known;
}

std::string StudyFolder::shard_file(int shard) const {
  return fmt::format("{}/shards/{}-of-{}.h5", folder_, shard + 1, shards_);
}

ShardState StudyFolder::state(int shard) const {
  if (!fs::exists(shard_file(shard))) return ShardState::absent;
  const Seal seal = seal_of(shard_file(shard));
  if (seal == Seal::broken) return ShardState::damaged;
  try {
    const ColumnReader file(shard_file(shard));
    const bool ours = file.text("content") == content_of_shard && file.whole("format") == shard_format &&
                      file.text("job") == job_ && file.whole("shard") == shard + 1 && file.whole("shards") == shards_;
    if (!ours) return ShardState::other_study;
    return seal == Seal::whole ? ShardState::finished : ShardState::unsealed;
  } catch (const Error& error) {
    if (error.problems.front().code != "damaged_file") throw;
    return ShardState::damaged;
  }
}

bool StudyFolder::compute(int shard, const std::function<bool(const StudyCounts&)>& go_on) const {
  ColumnWriter writer(shard_file(shard), study_heads(study_));
  std::vector<double> row;
  const auto keep = [&](const StudySample& sample) {
    row.assign(1, static_cast<double>(sample.draw));
    if (study_.keep_all) row.push_back(sample.accepted ? 1 : 0);
    row.insert(row.end(), sample.row.begin(), sample.row.end());
    writer.append(row);
  };
  const auto counts = compute_shard(study_, shard, shards_, keep, go_on);
  if (!counts) return false;
  FileFacts facts{{"content", content_of_shard},
                  {"format", shard_format},
                  {"program", "hysteron"},
                  {"job", job_},
                  {"shard", std::int64_t{shard + 1}},
                  {"shards", std::int64_t{shards_}},
                  {"seed", static_cast<std::int64_t>(study_.seed)}};
  add_counts(*counts, facts);
  writer.finish(facts, true);
  return true;
}

void StudyFolder::compute(const std::vector<int>& list, std::size_t there, int threads,
                          const std::function<void(const StudyProgress&)>& show) const {
  if (list.empty()) return;
  ShardWork work(*this, list);
  const int n = std::clamp(threads, 1, static_cast<int>(list.size()));
  std::vector<std::thread> workers;
  for (int i = 0; i < n; ++i) workers.emplace_back([&] { work.take_all(); });
  work.wait_for(n, show);
  for (auto& worker : workers) worker.join();
  work.rethrow();
  if (!stop_asked() || work.finished() == list.size()) return;
  throw Interrupted(fmt::format(
      "interrupted; {} of {} shards are finished and kept in {}/shards; the same command goes on from there",
      there + work.finished(), there + list.size(), folder_));
}

void StudyFolder::clean() const {
  std::error_code ignored;
  for (const auto& folder : {folder_, folder_ + "/shards"})
    for (const auto& entry : fs::directory_iterator(folder, ignored))
      if (may_be_left_over(entry.path().filename().string())) remove_leftover(entry.path().string());
}

}  // namespace hysteron
