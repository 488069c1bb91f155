// The batch scripts of a study, run by bash as Slurm would run them, with a program and a scontrol that write down how
// they were called.
#include "app/cluster/slurm_script.h"

#include <gtest/gtest.h>

#include "app/cluster/slurm.h"
#include "engine/diagram/error.h"
#include "io/files/shell_word.h"
#include "tests/app/hysteron_process.h"

namespace hysteron {
namespace {

using process::Folder;
using process::Outcome;
using process::shell;

SlurmStudy study_of(int shards, int tasks, std::vector<int> missing) {
  SlurmStudy study;
  study.title = "stage";
  study.shard_words = {"true"};
  study.merge_words = {"true"};
  study.folder = "/nowhere";
  study.shards = shards;
  study.tasks = tasks;
  study.missing = std::move(missing);
  return study;
}

TEST(SlurmScript, AnyWordComesThroughBashAsItIs) {
  const Folder folder;
  for (const std::string word :
       {"plain", "two words", "it's", "'", "a\"b", "$HOME `id` \\", "50% #done", "-n", "", "µm", "a\nb", "\n",
        "$'\t\\n'", "\x01\x7f\r1", "~", "*", "{a,b}", "!x", "a;b&c|d<e>f(g)[h]"}) {
    folder.write("script", "printf %s " + shell_word(word));
    EXPECT_EQ(shell(folder.path(), "bash script").out, word);
    EXPECT_EQ(shell_word(word).find('\n'), std::string::npos) << "a comment must not end in it";
  }
  EXPECT_EQ(shell_word("/home/me/a-1_2.json"), "/home/me/a-1_2.json");
}

TEST(SlurmScript, TheArrayHoldsTheTasksWithAShardToCompute) {
  EXPECT_EQ(array_of_tasks(study_of(4, 4, {1, 2, 3, 4})), "1-4");
  EXPECT_EQ(array_of_tasks(study_of(12, 12, {1, 3, 4, 5, 12})), "1,3-5,12");
  // Shards 2 and 5 of three tasks belong to task 2, shard 6 to task 3.
  EXPECT_EQ(array_of_tasks(study_of(6, 3, {2, 5, 6})), "2-3");
  EXPECT_EQ(array_of_tasks(study_of(4, 4, {})), "");
}

/// The folder of a study whose program is `program`, a script of bash that finds its words in "$*".
struct DemoRig {
  Folder folder;
  DemoRig(const std::string& program, int shards, int tasks) {
    SlurmStudy study = study_of(shards, tasks, {1});
    study.folder = folder.path();
    study.shard_words = {folder.path() + "/the program", "study", "a job.json"};
    study.merge_words = {folder.path() + "/the program", "study", "a job.json", "--merge"};
    folder.write("the program", "#!/bin/bash\necho \"$#: $*\" >> called\n" + program);
    // Slurm ends the job when it is requeued; here the script itself is ended, by its process number.
    folder.write("scontrol", "#!/bin/bash\necho \"$*\" >> scontrol_called\nkill -KILL $PPID\n");
    folder.write("shards.sh", shards_script(study));
    folder.write("merge.sh", merge_script(study));
    shell(folder.path(), "chmod +x 'the program' scontrol");
  }
  Outcome task(int number, int restart = 0) const {
    return shell(folder.path(), "PATH=$PWD:$PATH SLURM_ARRAY_JOB_ID=70 SLURM_ARRAY_TASK_ID=" + std::to_string(number) +
                                    (restart == 0 ? "" : " SLURM_RESTART_COUNT=" + std::to_string(restart)) +
                                    " bash shards.sh");
  }
};

TEST(SlurmScript, ATaskComputesItsShardsOneAfterTheOther) {
  const DemoRig demo_rig("", 7, 3);
  EXPECT_EQ(demo_rig.task(1).code, 0);
  EXPECT_EQ(demo_rig.folder.read("called"),
            "4: study a job.json --shard 1/7\n4: study a job.json --shard 4/7\n"
            "4: study a job.json --shard 7/7\n");
  EXPECT_FALSE(demo_rig.folder.has("scontrol_called"));
}

TEST(SlurmScript, AShardThatIsKilledIsRequeuedAndOnlyIt) {
  const DemoRig demo_rig("kill -KILL $$\n", 4, 4);
  const Outcome outcome = demo_rig.task(3);
  EXPECT_EQ(outcome.code, 137) << outcome.out;  // ended by the requeue
  EXPECT_EQ(demo_rig.folder.read("scontrol_called"), "requeue 70_3\n");
  EXPECT_NE(outcome.out.find("shard 3 was killed (signal 9)"), std::string::npos) << outcome.out;
}

TEST(SlurmScript, ATaskThatIsKilledAgainAndAgainEndsAndNamesTheMemory) {
  const DemoRig demo_rig("kill -KILL $$\n", 4, 4);
  const Outcome outcome = demo_rig.task(3, most_restarts);
  EXPECT_EQ(outcome.code, 137);
  EXPECT_FALSE(demo_rig.folder.has("scontrol_called"));
  EXPECT_NE(outcome.out.find("--mem"), std::string::npos) << outcome.out;
}

TEST(SlurmScript, WhatWouldFailAgainAndWhatWasStoppedIsNotRequeued) {
  // 2 wrong input, 3 numerics, 130 stopped by scancel or Ctrl-C (the program's own answer to both)
  for (const int code : {2, 3, 130}) {
    const DemoRig demo_rig("exit " + std::to_string(code) + "\n", 6, 3);
    EXPECT_EQ(demo_rig.task(1).code, code);
    EXPECT_FALSE(demo_rig.folder.has("scontrol_called")) << code;
    EXPECT_EQ(demo_rig.folder.read("called"), "4: study a job.json --shard 1/6\n");
  }
}

TEST(SlurmScript, AMergeThatFailsSaysWhereToLookAndKeepsItsCode) {
  const DemoRig demo_rig("exit 2\n", 4, 4);
  const Outcome outcome = shell(demo_rig.folder.path(), "bash merge.sh");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.out.find("task-*.log"), std::string::npos) << outcome.out;
  EXPECT_EQ(demo_rig.folder.read("called"), "3: study a job.json --merge\n");
}

TEST(SlurmScript, WordsForSbatchStandLastAndThoseThatHysteronDecidesAreRefused) {
  SlurmStudy study = study_of(2, 2, {1, 2});
  study.options = "--partition=short --time=0:30:00";
  for (const auto& script : {shards_script(study), merge_script(study)}) {
    const auto at = script.find("#SBATCH --partition=short --time=0:30:00\n");
    ASSERT_NE(at, std::string::npos) << script;
    EXPECT_EQ(script.find("#SBATCH", at + 1), std::string::npos) << script;
  }
  check_slurm_options(study.options);
  for (const char* words : {"--array=1-3", "--mem=1G -d afterok:1", "--output=/tmp/x", "--mem=1G\nrm x"})
    EXPECT_THROW(check_slurm_options(words), Error) << words;
}

TEST(SlurmScript, NoWordInItBecomesACommand) {
  const std::string bad = "o\ntouch broken;#'\"$(touch broken)`touch broken`\n#SBATCH --wrap=x";
  SlurmStudy study = study_of(1, 1, {1});
  study.title = study.folder = bad;
  study.shard_words = study.merge_words = {"printf", "%s", bad};
  const Folder folder;
  for (const auto& script : {shards_script(study), merge_script(study)}) {
    folder.write("script", script);
    const Outcome outcome = shell(folder.path(), "SLURM_ARRAY_TASK_ID=1 bash script");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find(bad), std::string::npos) << outcome.out;
    EXPECT_FALSE(folder.has("broken")) << script;
    for (std::size_t at = script.find('\n'); at + 1 < script.size(); at = script.find('\n', at + 1))
      EXPECT_FALSE(script.compare(at + 1, 14, "#SBATCH --wrap") == 0) << script;
  }
}

TEST(SlurmScript, ATitleCannotBreakTheScript) {
  SlurmStudy study = study_of(2, 2, {1, 2});
  study.title = "a \"stage\"\n$(touch broken) \\";
  const Folder folder;
  folder.write("merge.sh", merge_script(study));
  EXPECT_EQ(shell(folder.path(), "bash merge.sh").code, 0);
  EXPECT_FALSE(folder.has("broken"));
}

}  // namespace
}  // namespace hysteron
