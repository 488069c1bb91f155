// Decides how a study is handed to Slurm: the scripts on the disk, the two submissions, what the user is told.
// Slurm's programs are asked by their words and answer in their machine-readable forms; no shell is between.
#include "app/cluster/slurm.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "app/cluster/child_process.h"
#include "engine/diagram/error.h"
#include "engine/diagram/number_text.h"
#include "io/files/atomic_file.h"
#include "io/files/shell_word.h"

namespace hysteron {
namespace {

namespace fs = std::filesystem;

constexpr int usual_array_size = 1001;  // Slurm's default of MaxArraySize; indices stay below it

std::string jobs_file(const std::string& folder) { return folder + "/jobs.txt"; }

std::string without_newlines_at_end(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  return text;
}

[[noreturn]] void no_slurm(const std::string& folder) {
  fail("no_slurm", "sbatch", "the program sbatch, which takes jobs for Slurm, is not on this machine",
       fmt::format("give the command on the machine of the cluster from which jobs are submitted; or without --slurm, "
                   "to compute here. The scripts lie in {} and can be submitted by hand",
                   folder));
}

/// Submits one script and returns its number.
std::string sbatch(const std::string& folder, std::vector<std::string> options, const std::string& script) {
  std::vector<std::string> words{"sbatch", "--parsable"};
  words.insert(words.end(), options.begin(), options.end());
  words.push_back(script);
  const ChildOutcome answer = run_child(words, folder);
  if (!answer.found) no_slurm(folder);
  // "NUMBER" or "NUMBER;CLUSTER", behind whatever a site has sbatch say first
  const std::string text = without_newlines_at_end(answer.out);
  const std::string line = text.substr(text.rfind('\n') + 1);
  const std::string number = line.substr(0, line.find(';'));
  if (answer.code != 0 || number.empty() || number.find_first_not_of("0123456789") != std::string::npos)
    fail("slurm_refused", folder + "/" + script,
         fmt::format("sbatch does not take the script: {}", without_newlines_at_end(answer.err + answer.out)),
         "what the cluster asks for (partition, account, time, memory) is given by "
         "--slurm-options=\"--partition=NAME --time=1:00:00\"; fewer tasks by --slurm-tasks");
  return number;
}

}  // namespace

void check_slurm_options(const std::string& options) {
  if (options.find_first_of("\n\r") != std::string::npos)
    fail("bad_slurm_options", "--slurm-options", "the words for sbatch are more than one line",
         "write them behind each other, with spaces between");
  std::istringstream words(options);
  for (std::string word; words >> word;) {
    const std::string name = word.substr(0, word.find('='));
    for (const char* own : {"--array", "-a", "--dependency", "-d", "--output", "-o", "--wrap"})
      if (name == own)
        fail("bad_slurm_options", "--slurm-options", fmt::format("{} is decided by hysteron", own),
             "leave it out; give the partition, the account, the time, the memory and the like");
  }
}

int most_slurm_tasks() {
  const ChildOutcome answer = run_child({"scontrol", "show", "config"});
  int size = usual_array_size;
  std::istringstream lines(answer.out);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("MaxArraySize"))
      size = leading_whole_number(line.substr(std::min(line.find_first_of("0123456789"), line.size())), 0);
  return size > 1 ? size - 1 : 1;
}

void refuse_second_submission(const std::string& folder) {
  if (!fs::exists(jobs_file(folder))) return;
  const std::string jobs = without_newlines_at_end(read_file(jobs_file(folder)));
  // Numbers that Slurm has forgotten are no error worth telling: these jobs are over.
  const ChildOutcome answer = run_child({"squeue", "--noheader", "--format=%i", "--jobs=" + jobs});
  if (!answer.found || answer.code != 0 || without_newlines_at_end(answer.out).empty()) return;
  fail("study_is_running", folder, fmt::format("jobs {} of this study wait or run in Slurm", jobs),
       fmt::format("wait for them (squeue --jobs={0}), or stop them: scancel {1}", jobs,
                   jobs.find(',') == std::string::npos
                       ? jobs
                       : jobs.substr(0, jobs.find(',')) + " " + jobs.substr(jobs.find(',') + 1)));
}

void write_slurm_scripts(const SlurmStudy& study) {
  std::error_code error;
  fs::create_directories(study.folder, error);
  if (error)
    fail("cannot_write", study.folder, "the folder for the scripts cannot be made: " + error.message(),
         "choose another folder with -o, one that every node of the cluster sees");
  fs::remove(study.folder + "/shards.sh", error);
  if (!study.missing.empty()) write_file(study.folder + "/shards.sh", shards_script(study));
  write_file(study.folder + "/merge.sh", merge_script(study));
}

SlurmJobs submit_to_slurm(const SlurmStudy& study) {
  SlurmJobs jobs;
  if (!study.missing.empty()) jobs.shards = sbatch(study.folder, {}, "shards.sh");
  try {
    // "any" and not "ok": where a task fails, the merge says which shards are missing instead of waiting for ever.
    // A task that is requeued counts as not ended.
    jobs.merge = sbatch(study.folder,
                        jobs.shards.empty() ? std::vector<std::string>{}
                                            : std::vector<std::string>{"--dependency=afterany:" + jobs.shards},
                        "merge.sh");
  } catch (const Error&) {
    if (!jobs.shards.empty()) run_child({"scancel", jobs.shards});
    throw;
  }
  write_file(jobs_file(study.folder), (jobs.shards.empty() ? "" : jobs.shards + ",") + jobs.merge + "\n");
  return jobs;
}

std::string slurm_hints(const SlurmStudy& study, const SlurmJobs& jobs) {
  const bool array = !jobs.shards.empty();
  return fmt::format(
      "  watch  squeue --jobs={0}\n"
      "  read   {1}/{2}merge.log\n"
      "  stop   scancel {3}\n"
      "A shard whose node is lost, or that is killed, is started again. Should the merge find shards missing, the same "
      "command\ncomputes those and keeps the rest.\n",
      array ? jobs.shards + "," + jobs.merge : jobs.merge, shell_word(study.folder), array ? "task-*.log, then " : "",
      array ? jobs.shards + " " + jobs.merge : jobs.merge);
}

}  // namespace hysteron
