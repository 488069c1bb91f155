// Decides how jobs are kept: each in a folder .hysteron/jobs/ID with its command line, its streams and its results, so
// that a studio that is started anew finds them all. One after the other where the cores do not suffice.
// Does not compute: a job is the command line, in a process of its own.
#pragma once

#include <condition_variable>
#include <map>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <thread>
#include <vector>

#include "studio/child.h"
#include "studio/job_words.h"

namespace hysteron::studio {

struct JobSettings {
  std::string program;  ///< path of hysteron
  std::vector<JobVerb> verbs;
  std::vector<std::string> allowed;
  int threads = 1;  ///< of all jobs together
};

class Jobs {
 public:
  /// Takes up the jobs that lie in the folder: those that run go on.
  Jobs(const OpenFolder& folder, JobSettings settings);
  /// Jobs that run go on by themselves.
  ~Jobs();
  Jobs(const Jobs&) = delete;
  Jobs& operator=(const Jobs&) = delete;

  /// Begins a job and returns its id. Throws as job_words().
  std::string begin(const nlohmann::json& asked);
  /// Ends a job as Ctrl-C does; one that has not ended 10 s later is killed. Throws Error "no_job".
  void cancel(const std::string& id);
  /// Removes a job that has ended, with its results. Throws Error "no_job", "job_runs".
  void remove(const std::string& id);
  /// [{"id", "verb", "diagram", "data", "words", "folder", "state", "fraction", "what", "seconds_left", "headline",
  /// "exit_code", "problems", "began", "stale"}], the newest first. "state": "waiting", "running", "done", "failed",
  /// "cancelled", "lost" (it ended and nobody knows how). "stale": diagram or data were changed since.
  nlohmann::ordered_json list() const;

 private:
  struct Job;
  void take_up();
  void watch();
  void look_after(Job& job);
  void start_waiting();
  void finish(Job& job, int code);
  std::string place(const std::string& id) const;
  Job& find(const std::string& id);

  const OpenFolder& folder_;
  JobSettings settings_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::string, Job> jobs_;
  bool ends_ = false;
  std::thread watcher_;
};

}  // namespace hysteron::studio
