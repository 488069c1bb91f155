#include "studio/jobs.h"

#include <signal.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "engine/diagram/error.h"
#include "io/files/atomic_file.h"
#include "studio/job_log.h"

namespace hysteron::studio {

namespace fs = std::filesystem;
using nlohmann::json;
using Clock = std::chrono::steady_clock;

namespace {

constexpr auto look_every = std::chrono::milliseconds(30);
constexpr auto patience = std::chrono::seconds(10);  // of one that was asked to end

/// Ids sort as the jobs began: the time in ms and a count.

std::string id_of(long long milliseconds, int count) {
  std::string id = std::to_string(milliseconds);
  return id + "-" + std::to_string(count);
}

/// Verbs that use all the threads that they are given.
bool is_parallel(const JobVerb& verb) {
  return std::any_of(verb.options.begin(), verb.options.end(), [](const auto& o) { return o.name == "--threads"; });
}

}  // namespace

struct Jobs::Job {
  json told;  ///< what job.json says: id, verb, diagram, data, words, began, digests, pid, started
  std::string state = "waiting";
  Child child{};
  int threads = 1;
  LogTail log{};
  int exit_code = -1;
  std::string headline{};
  json problems = json::array();
  bool asked_to_end = false;
  Clock::time_point asked_at{};
};

Jobs::Jobs(const OpenFolder& folder, JobSettings settings) : folder_(folder), settings_(std::move(settings)) {
  take_up();
  watcher_ = std::thread([this] { watch(); });
}

Jobs::~Jobs() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  changed_.notify_all();
  watcher_.join();
}

std::string Jobs::place(const std::string& id) const { return folder_.path() + "/.hysteron/jobs/" + id; }

Jobs::Job& Jobs::find(const std::string& id) {
  const auto found = jobs_.find(id);
  if (found == jobs_.end()) fail("no_job", id, "there is no such job", "reload the page");
  return found->second;
}

std::string Jobs::begin(const json& asked) {
  const auto words = job_words(asked, settings_.verbs, folder_);
  const auto now =
      std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::system_clock::now().time_since_epoch());
  const std::lock_guard lock(mutex_);
  int count = 0;
  while (jobs_.contains(id_of(now.count(), count))) ++count;
  const std::string id = id_of(now.count(), count);
  fs::create_directories(place(id));
  std::ofstream(folder_.path() + "/.hysteron/.gitignore") << "*\n";

  Job job;
  const auto verb = std::find_if(settings_.verbs.begin(), settings_.verbs.end(),
                                 [&](const JobVerb& v) { return v.name == words.front(); });
  std::vector<std::string> all = words;
  all.insert(all.end(), {"-o", ".hysteron/jobs/" + id + "/out"});
  for (const char* word : {"--json", "--errors=json", "--progress=json"}) all.emplace_back(word);
  for (const auto& allowed : settings_.allowed) all.push_back("--allow=" + allowed);
  const bool names_threads = asked.value("options", json::object()).contains("--threads");
  if (is_parallel(*verb)) job.threads = settings_.threads;
  if (is_parallel(*verb) && !names_threads) all.push_back("--threads=" + std::to_string(settings_.threads));
  const std::string data = asked.value("options", json::object()).value("--data", "");
  json digests = {{asked.at("diagram").get<std::string>(), digest_of(folder_.file(asked.at("diagram")))}};
  if (!data.empty()) digests[data] = digest_of(folder_.file(data));
  job.told = {{"id", id},     {"verb", words.front()}, {"diagram", asked.at("diagram")}, {"data", data},
              {"words", all}, {"asked", asked},        {"began", now.count()},           {"digests", digests}};
  write_file(place(id) + "/job.json", job.told.dump(1) + "\n");
  jobs_.emplace(id, std::move(job));
  start_waiting();
  changed_.notify_all();
  return id;
}

/// With the lock held.
void Jobs::start_waiting() {
  int busy = 0;
  for (const auto& [id, job] : jobs_)
    if (job.state == "running") busy += job.threads;
  for (auto& [id, job] : jobs_) {
    if (job.state != "waiting" || (busy > 0 && busy + job.threads > settings_.threads)) continue;
    std::vector<std::string> words{settings_.program};
    for (const auto& word : job.told["words"]) words.push_back(word);
    try {
      job.child = start_child(words, folder_.path(), place(id) + "/answer.json", place(id) + "/log");
    } catch (const Error& error) {
      job.problems.push_back(
          {{"code", "cannot_start"}, {"what", error.problems[0].what}, {"cure", error.problems[0].cure}});
      job.state = "failed";
      continue;
    }
    job.state = "running";
    job.told["pid"] = job.child.pid;
    job.told["started"] = job.child.started;
    write_file(place(id) + "/job.json", job.told.dump(1) + "\n");
    busy += job.threads;
  }
}

void Jobs::watch() {
  std::unique_lock lock(mutex_);
  while (!ends_) {
    bool busy = false;
    for (auto& [id, job] : jobs_) {
      if (job.state == "running") look_after(job);
      busy = busy || job.state == "running" || job.state == "waiting";
    }
    start_waiting();
    if (busy)
      changed_.wait_for(lock, look_every);
    else
      changed_.wait(lock);
  }
}

void Jobs::look_after(Job& job) {
  job.log.read(place(job.told["id"]) + "/log");
  if (const auto code = exit_code_of(job.child)) return finish(job, *code);
  if (!is_alive(job.child)) return finish(job, exit_code_of(job.child).value_or(-1));  // it may have ended just now
  if (job.asked_to_end && Clock::now() - job.asked_at > patience) signal_child(job.child, SIGKILL);
}

/// `code` -1: nobody knows; then what it wrote tells.
void Jobs::finish(Job& job, int code) {
  const std::string folder = place(job.told["id"]);
  job.log.read(folder + "/log");
  const json answer = json::parse(std::ifstream(folder + "/answer.json"), nullptr, false);
  const json failure = job.log.failure();
  if (answer.is_object()) {
    job.headline = answer.value("headline", "");
    if (code < 0) code = answer.value("exit_code", 0);
  } else if (failure.is_object()) {
    job.problems = failure["problems"];
    if (code < 0) code = failure.value("exit_code", 2);
  }
  constexpr int interrupted = 130, question_answered_no = 1;
  job.exit_code = code;
  job.state = answer.is_object() && (code == 0 || code == question_answered_no) ? "done"
              : code == interrupted || job.asked_to_end                         ? "cancelled"
              : code < 0                                                        ? "lost"
                                                                                : "failed";
  constexpr int first_signal = 128;
  if (job.state == "failed" && job.problems.empty())
    job.problems.push_back(
        {{"code", "job_ended"},
         {"what", code > first_signal ? "the process was killed by signal " + std::to_string(code - first_signal)
                                      : "the process ended with exit code " + std::to_string(code)},
         {"cure", "look whether the machine is short of memory, and run it again"}});
  job.told["exit_code"] = job.exit_code;
  job.told["state"] = job.state;
  write_file(folder + "/job.json", job.told.dump(1) + "\n");
}

void Jobs::take_up() {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder_.path() + "/.hysteron/jobs", error)) {
    const json told = json::parse(std::ifstream(entry.path() / "job.json"), nullptr, false);
    if (!told.is_object() || told.value("id", "") != entry.path().filename().string()) continue;
    Job job;
    job.told = told;
    job.child = {told.value("pid", 0), told.value("started", 0ULL)};
    job.log.read((entry.path() / "log").string());
    if (told.contains("state") || (job.child.pid > 0 && !is_alive(job.child))) {
      job.asked_to_end = told.value("state", "") == "cancelled";
      finish(job, told.value("exit_code", -1));
    } else {
      job.state = job.child.pid > 0 ? "running" : "waiting";
    }
    jobs_.emplace(told["id"], std::move(job));
  }
}

void Jobs::cancel(const std::string& id) {
  const std::lock_guard lock(mutex_);
  Job& job = find(id);
  if (job.state == "waiting") job.state = "cancelled";
  if (job.state != "running" || job.asked_to_end) return;
  job.asked_to_end = true;
  job.asked_at = Clock::now();
  signal_child(job.child, SIGINT);
}

void Jobs::remove(const std::string& id) {
  const std::lock_guard lock(mutex_);
  if (find(id).state == "running") fail("job_runs", id, "the job is still running", "cancel it first");
  std::error_code error;
  fs::remove_all(place(id), error);
  jobs_.erase(id);
}

nlohmann::ordered_json Jobs::list() const {
  const std::lock_guard lock(mutex_);
  std::map<std::string, std::string> now;  // digests of files that several jobs name
  const auto digest_now = [&](const std::string& file) {
    const auto [known, is_new] = now.try_emplace(file);
    if (is_new) known->second = digest_of(folder_.path() + "/" + file);
    return known->second;
  };
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (auto i = jobs_.rbegin(); i != jobs_.rend(); ++i) {
    const Job& job = i->second;
    bool stale = false;
    for (const auto& [file, digest] : job.told["digests"].items()) stale = stale || digest_now(file) != digest;
    list.push_back({{"id", job.told["id"]},
                    {"verb", job.told["verb"]},
                    {"diagram", job.told["diagram"]},
                    {"data", job.told["data"]},
                    {"words", job.told["words"]},
                    {"asked", job.told["asked"]},
                    {"folder", ".hysteron/jobs/" + i->first + "/out"},
                    {"state", job.state},
                    {"fraction", job.log.fraction()},
                    {"what", job.log.what()},
                    {"seconds_left", job.log.seconds_left()},
                    {"headline", job.headline},
                    {"exit_code", job.exit_code},
                    {"problems", job.problems},
                    {"began", job.told["began"]},
                    {"stale", stale}});
  }
  return list;
}

}  // namespace hysteron::studio
