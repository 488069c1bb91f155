// Decides what "hysteron study --slurm" does: checks the study here, and hands what is missing of it to a cluster.
#include "app/study/study_slurm.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "app/cluster/slurm.h"
#include "engine/diagram/error.h"
#include "io/files/shell_word.h"
#include "report/pages/numbers.h"

namespace hysteron {
namespace {

namespace fs = std::filesystem;

/// As every node of the cluster sees it. Links are kept: /home/me may lie elsewhere on each node.
std::string absolute(const std::string& path) { return fs::absolute(path).lexically_normal().string(); }

std::string this_program() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (error)
    fail("no_program", "/proc/self/exe", "the system does not say where hysteron itself lies: " + error.message(),
         "submit by hand: hysteron study JOB -o FOLDER --shard K/N for each shard, then --merge");
  return program.string();
}

/// As many as there are shards, unless the user or the cluster wants fewer; then each task computes several.
int tasks_for(const Arguments& arguments, int shards) {
  int most = most_slurm_tasks();
  if (arguments.has("--slurm-tasks")) {
    const double wanted = arguments.number("--slurm-tasks", most);
    if (!(wanted >= 1) || wanted != std::floor(wanted))
      fail("bad_command_line", "--slurm-tasks", "the number of tasks is not a whole number from 1",
           "give a number such as --slurm-tasks 100");
    most = static_cast<int>(std::min<double>(wanted, most));
  }
  return std::min(most, shards);
}

std::vector<int> missing_shards(const StudyFolder& folder) {
  std::vector<int> missing;
  for (int k = 0; k < folder.shards(); ++k)
    if (!can_be_merged(folder.state(k))) missing.push_back(k + 1);
  return missing;
}

/// "12 of 16 shards are missing, 100 tasks"
std::string work_text(const SlurmStudy& study) {
  const int missing = static_cast<int>(study.missing.size());
  if (missing == 0) return fmt::format("all {} shards are finished; the merge alone", study.shards);
  std::string text = missing == study.shards ? count_text(missing, "shard")
                                             : fmt::format("{} of {} shards are missing", missing, study.shards);
  if (study.tasks < study.shards)
    text += fmt::format("; {} at most, each with up to {}", count_text(study.tasks, "task"),
                        count_text((study.shards + study.tasks - 1) / study.tasks, "shard"));
  return text;
}

}  // namespace

std::vector<OptionSpec> slurm_options() {
  return {{"--slurm", "", "submit the shards and the merge to Slurm (docs/clusters.md)", false, false},
          {"--slurm-options", "WORDS", "words for sbatch, e.g. \"--partition=short --time=1:00:00\"", false, false},
          {"--slurm-tasks", "N", "at most so many tasks; several shards each where there are more", false, false},
          {"--slurm-dry-run", "", "write the scripts for Slurm, submit nothing", false, false}};
}

bool wants_slurm(const Arguments& arguments) {
  const auto options = slurm_options();
  return std::any_of(options.begin(), options.end(), [&](const OptionSpec& o) { return arguments.has(o.name); });
}

Answer submit_study(const Arguments& arguments, const std::string& job, const std::string& title,
                    const StudyFolder& folder, const std::vector<std::string>& words,
                    const std::vector<std::string>& merge_words) {
  SlurmStudy study;
  study.title = title;
  study.folder = absolute(folder.file("slurm"));
  study.options = arguments.text("--slurm-options");
  study.shards = folder.shards();
  study.missing = missing_shards(folder);
  check_slurm_options(study.options);
  study.tasks = tasks_for(arguments, study.shards);
  study.shard_words = {this_program(), "study", absolute(job), "-o", fs::path(study.folder).parent_path().string()};
  study.shard_words.insert(study.shard_words.end(), words.begin(), words.end());
  study.merge_words = study.shard_words;
  study.merge_words.insert(study.merge_words.end(), merge_words.begin(), merge_words.end());
  study.merge_words.push_back("--merge");

  const bool dry = arguments.has("--slurm-dry-run");
  if (!dry) refuse_second_submission(study.folder);
  write_slurm_scripts(study);
  Answer answer;
  if (!study.missing.empty()) answer.files.push_back({study.folder + "/shards.sh", "", true});
  answer.files.push_back({study.folder + "/merge.sh", "", true});
  SlurmJobs jobs;
  if (dry) {
    answer.text =
        fmt::format("{}: {}; nothing was submitted\n  by hand: cd {}, then as {} says\n", title, work_text(study),
                    shell_word(study.folder), study.missing.empty() ? "merge.sh" : "shards.sh");
  } else {
    jobs = submit_to_slurm(study);
    answer.text =
        fmt::format("{}: {}; submitted as job {}\n", title, work_text(study),
                    jobs.shards.empty() ? jobs.merge : fmt::format("{}, the merge as job {}", jobs.shards, jobs.merge));
    if (!arguments.quiet()) answer.text += slurm_hints(study, jobs);
  }
  answer.facts = Facts::object({{"submitted", !dry},
                                {"shards", study.shards},
                                {"missing", study.missing.size()},
                                {"jobs", Facts::object({{"shards", jobs.shards}, {"merge", jobs.merge}})}});
  return answer;
}

}  // namespace hysteron
