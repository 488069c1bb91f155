// Decides what a cluster that runs Slurm is asked to do: the two batch scripts of a study, whole and readable.
// No path stands in an #SBATCH line: logs are named relative to the folder in which the scripts are submitted, so that
// no folder's name has to survive the rules by which sbatch reads these lines.
#include "app/cluster/slurm_script.h"

#include <fmt/format.h>

#include <set>

#include "io/files/shell_word.h"

namespace hysteron {
namespace {

std::string shell_words(const std::vector<std::string>& words) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : " ") + shell_word(word);
  return text;
}

/// A title as a comment or as the name of a job: one line, no quotes.
std::string plain(const std::string& title) {
  std::string text;
  for (const char c : title) text += is_control(c) || c == '"' || c == '\\' ? ' ' : c;
  return text;
}

/// Options that both jobs have. Those of the user come last: of two equal ones sbatch takes the last.
std::string sbatch_lines(const SlurmStudy& study, const std::string& what, const std::string& log) {
  std::string lines = fmt::format(
      "#SBATCH --job-name=\"{}: {}\"\n"
      "#SBATCH --ntasks=1\n"
      "#SBATCH --cpus-per-task=1\n"
      "#SBATCH --requeue\n"
      "#SBATCH --open-mode=append\n"
      "#SBATCH --output={}\n",
      plain(study.title), what, log);
  if (!study.options.empty()) lines += "#SBATCH " + study.options + "\n";
  return lines;
}

/// A lost node is Slurm's affair (--requeue). That a program was killed on a healthy node, for want of memory for
/// example, Slurm takes for the end of the job; so the script asks for a new start itself. A program that ends by
/// itself, whatever it says, is not started again; nor one that was told to stop (130, 143).
constexpr char shard_loop[] = R"bash(
me=${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID
restart=${SLURM_RESTART_COUNT:-0}
echo "task $SLURM_ARRAY_TASK_ID, start $((restart + 1)), on ${SLURMD_NODENAME:-$(uname -n)}, $(date)"
for (( shard = SLURM_ARRAY_TASK_ID; shard <= shards; shard += tasks )); do
  "${compute[@]}" --shard "$shard/$shards"
  code=$?
  if (( code == 0 )); then continue; fi
  if (( code > 128 && code != 130 && code != 143 )); then
    echo "shard $shard was killed (signal $((code - 128)))"
    if (( restart >= restarts )); then
      echo "it is not started again after $restart restarts; was the memory enough (--slurm-options=--mem=2G)?"
    elif scontrol requeue "$me"; then
      echo "it is started again"
      sleep 600  # Slurm ends this start meanwhile
    else
      echo "Slurm refused to start it again"
    fi
  fi
  exit "$code"
done
)bash";

constexpr char merging[] = R"bash(
echo "merge on ${SLURMD_NODENAME:-$(uname -n)}, $(date)"
"${merge[@]}"
code=$?
if (( code != 0 )); then
  echo "If shards are missing: why stands in the task-*.log beside this file."
  echo "The same command with --slurm once more computes what is missing and keeps the rest."
fi
exit "$code"
)bash";

}  // namespace

std::string array_of_tasks(const SlurmStudy& study) {
  std::set<int> tasks;
  for (const int shard : study.missing) tasks.insert((shard - 1) % study.tasks + 1);
  std::string text;
  for (auto task = tasks.begin(); task != tasks.end();) {
    const int first = *task;
    int last = first;
    for (++task; task != tasks.end() && *task == last + 1; ++task) last = *task;
    text += (text.empty() ? "" : ",") + (first == last ? std::to_string(first) : fmt::format("{}-{}", first, last));
  }
  return text;
}

std::string shards_script(const SlurmStudy& study) {
  return fmt::format(
      "#!/bin/bash\n"
      "# The shards of \"{}\" as an array of Slurm jobs. By hand, where hysteron may not submit:\n"
      "#   cd {}\n"
      "#   sbatch --parsable shards.sh                        says NUMBER\n"
      "#   sbatch --dependency=afterany:NUMBER merge.sh\n"
      "#SBATCH --array={}\n"
      "{}\n"
      "compute=({})\n"
      "shards={}\n"
      "tasks={}     # each computes the shards whose number is its own, its own + tasks ...\n"
      "restarts={}  # most of them, of one task\n"
      "{}",
      plain(study.title), shell_word(study.folder), array_of_tasks(study), sbatch_lines(study, "shards", "task-%a.log"),
      shell_words(study.shard_words), study.shards, study.tasks, most_restarts, shard_loop);
}

std::string merge_script(const SlurmStudy& study) {
  return fmt::format(
      "#!/bin/bash\n"
      "# Joins the shards of \"{}\" when all tasks of shards.sh have ended, well or not: it says what is missing.\n"
      "{}\n"
      "merge=({})\n"
      "{}",
      plain(study.title), sbatch_lines(study, "merge", "merge.log"), shell_words(study.merge_words), merging);
}

}  // namespace hysteron
