#include "app/jobs/published_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

#include "engine/diagram/error.h"
#include "engine/diagram/stop.h"

namespace hysteron {
namespace {

/// What stands in place of a job whose numerics failed: none of its claims holds.
void tell_failure(const PublishedJob& job, const Error& error, JobPool& pool, JobDone& d) {
  const Problem& p = error.problems.front();
  d.failed = fmt::format("{} failed: {}: {}", job.name, p.path, p.what);
  d.parts.clear();
  for (const auto& claim : pool.job(job.file).job().claims)
    d.parts.push_back(
        {job.name, claim.id, false, "the run failed: " + p.what, claim.expected ? claim.expected->text : "-", p.cure});
  d.page = {};
  d.page.section.title = figure_name(job.name);
  d.page.section.text.push_back(d.failed);
}

using Clock = std::chrono::steady_clock;
/// Claims judged and figures drawn, from runs that are done by now or are done here.
JobDone done(const PublishedJob& job, JobPool& pool) {
  JobDone d;
  try {
    JobRunner& runner = pool.job(job.file);
    for (const auto& claim : runner.job().claims) d.parts.push_back(judge(runner, claim));
    d.page = page_of(runner, pool.allowed());
  } catch (const Error& error) {
    if (error.fault == Fault::input)
      d.error = std::current_exception();
    else
      tell_failure(job, error, pool, d);
  } catch (...) {
    d.error = std::current_exception();
  }
  return d;
}

/// One piece of work for a thread: a run of a job, or (no run) its claims and figures.
struct Task {
  std::size_t job = 0;
  const RunWish* run = nullptr;
  double seconds = 0;
  std::exception_ptr stopped{};  ///< of the run; other threads may be at the other tasks of its job
};

/// The runs of each job, then what is made of them.
std::vector<Task> tasks_of(const std::vector<PublishedJob>& jobs, JobPool& pool) {
  std::vector<Task> tasks;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    for (const auto& run : pool.job(jobs[i].file).job().runs)
      if (run.kind != RunKind::elsewhere) tasks.push_back({.job = i, .run = &run});
    tasks.push_back({.job = i});
  }
  return tasks;
}

void do_task(Task& task, const std::vector<PublishedJob>& jobs, JobPool& pool, std::vector<JobDone>& results) {
  const auto begin = Clock::now();
  if (task.run == nullptr) {
    results[task.job] = done(jobs[task.job], pool);
  } else {
    try {
      pool.job(jobs[task.job].file).shared_result({task.run->name, task.run->pointer});
    } catch (const std::exception&) {
      // Told by the task that needs the run, with what it was needed for.
    } catch (const Stopped&) {
      task.stopped = std::current_exception();
    }
  }
  task.seconds = seconds_since(begin);
}

}  // namespace

std::vector<JobDone> run_all(const std::vector<PublishedJob>& jobs, JobPool& pool, const Watch& watch) {
  std::vector<JobDone> results(jobs.size());
  std::vector<Task> tasks = tasks_of(jobs, pool);
  std::atomic<std::size_t> next{0}, ready{0};
  const auto work = [&, asked = current_stop()] {
    const StopScope same(asked);
    for (std::size_t i = next++; i < tasks.size(); i = next++) {
      do_task(tasks[i], jobs, pool, results);
      ++ready;
    }
  };
  std::vector<std::thread> threads;
  const unsigned count = std::clamp(std::thread::hardware_concurrency(), 1U, 8U);
  for (unsigned i = 0; i < count; ++i) threads.emplace_back(work);
  while (ready < tasks.size()) {
    const std::size_t now = std::clamp<std::size_t>(next, 1, tasks.size()) - 1;
    watch.show(static_cast<double>(ready) / static_cast<double>(tasks.size()),
               fmt::format("{}, figure {} of {}", jobs[tasks[now].job].name, tasks[now].job + 1, jobs.size()));
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  for (auto& thread : threads) thread.join();
  for (const auto& task : tasks) results[task.job].seconds += task.seconds;
  for (const auto& d : results)
    if (d.error) std::rethrow_exception(d.error);
  for (const auto& task : tasks)
    if (task.stopped) std::rethrow_exception(task.stopped);
  return results;
}

}  // namespace hysteron
