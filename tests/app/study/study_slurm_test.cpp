// hysteron study --slurm where the programs of Slurm are stand-ins that write down how they were called; the real ones
// are asked in slurm_cluster_test.cpp.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/app/hysteron_process.h"
#include "tests/app/small_study.h"

namespace hysteron {
namespace {

namespace fs = std::filesystem;
using process::Folder;
using process::hysteron;
using process::Outcome;
using process::shell;

/// A laboratory with a study, whose folder has a space and a quote in its name, and a Slurm of stand-ins.
struct Site {
  Folder folder;
  Site() {
    small_study::write(folder, "my 'lab'/", 40);
    // Numbers 41, 42, ...; says where it was called and how.
    stand_in("sbatch", "echo \"$PWD: $*\" >> $SITE/sbatch_called; echo $(( 40 + $(wc -l < $SITE/sbatch_called) ))");
    stand_in("scontrol", "echo 'Configuration data'; echo 'MaxArraySize            = 1001'");
    stand_in("squeue", "true");
    stand_in("scancel", "echo \"$*\" > $SITE/scancel_called");
  }
  void stand_in(const std::string& name, const std::string& content) const {
    folder.write("bin/" + name, "#!/bin/sh\n" + content + "\n");
    shell(folder.path(), "chmod +x bin/" + name);
  }
  Outcome study(const std::string& words) const {
    return shell(folder.path() + "/my 'lab'", "SITE=" + folder.path() + " PATH=" + folder.path() +
                                                  "/bin:$PATH hysteron study job.json -o out " + words);
  }
  std::string calls() const { return folder.has("sbatch_called") ? folder.read("sbatch_called") : ""; }
  std::string read(const std::string& name) const { return folder.read("my 'lab'/" + name); }
  bool has(const std::string& name) const { return folder.has("my 'lab'/" + name); }
};

/// The only problem of a command that was given with --errors json.
nlohmann::json problem_of(const Outcome& outcome) {
  EXPECT_EQ(outcome.code, 2) << outcome.out << outcome.err;
  const auto failure = nlohmann::json::parse(outcome.err, nullptr, false);
  EXPECT_TRUE(failure.is_object()) << outcome.err;
  return failure.is_object() ? failure["problems"][0] : nlohmann::json::object();
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(StudySlurm, SubmitsTheShardsAndTheMergeBehindThem) {
  const Site site;
  const Outcome outcome = site.study("--slurm --slurm-options '--partition=short --mem=1G'");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const std::string at = site.folder.path() + "/my 'lab'/out/slurm: --parsable ";
  EXPECT_EQ(site.calls(), at + "shards.sh\n" + at + "--dependency=afterany:41 merge.sh\n");
  EXPECT_TRUE(holds(site.read("out/slurm/shards.sh"), "#SBATCH --array=1-4\n"));
  EXPECT_TRUE(holds(site.read("out/slurm/merge.sh"), "#SBATCH --partition=short --mem=1G\n"));
  for (const char* part : {"job 41, the merge as job 42", "squeue --jobs=41,42", "scancel 41 42"})
    EXPECT_TRUE(holds(outcome.out, part)) << outcome.out;
}

TEST(StudySlurm, TheScriptsComputeWhatThePlainCommandComputes) {
  const Site site;
  ASSERT_EQ(site.study("--slurm --slurm-tasks 3 --csv").code, 0);
  ASSERT_TRUE(holds(site.read("out/slurm/shards.sh"), "#SBATCH --array=1-3\n"));
  for (const char* task : {"3", "1", "2"}) {  // in any order
    const Outcome done = shell("/", std::string("SLURM_ARRAY_TASK_ID=") + task + " bash \"" + site.folder.path() +
                                        "/my 'lab'/out/slurm/shards.sh\"");
    EXPECT_EQ(done.code, 0) << done.out << done.err;
  }
  const Outcome merged = shell("/", "bash \"" + site.folder.path() + "/my 'lab'/out/slurm/merge.sh\"");
  EXPECT_EQ(merged.code, 0) << merged.out << merged.err;
  ASSERT_EQ(shell(site.folder.path() + "/my 'lab'", "hysteron study job.json -o plain --csv").code, 0);
  for (const char* file : {"study.h5", "study.csv"}) {
    EXPECT_FALSE(site.read(std::string("plain/") + file).empty());
    EXPECT_TRUE(site.read(std::string("out/") + file) == site.read(std::string("plain/") + file)) << file;
  }
}

TEST(StudySlurm, FinishedShardsAreNotSubmittedAgain) {
  const Site site;
  ASSERT_EQ(site.study("--shard 2/4").code, 0);
  ASSERT_EQ(site.study("--slurm").code, 0);
  EXPECT_TRUE(holds(site.read("out/slurm/shards.sh"), "#SBATCH --array=1,3-4\n"));
  for (const char* shard : {"1/4", "3/4", "4/4"}) ASSERT_EQ(site.study(std::string("--shard ") + shard).code, 0);
  const Outcome outcome = site.study("--slurm");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const std::string calls = site.calls();
  EXPECT_TRUE(calls.ends_with("out/slurm: --parsable merge.sh\n")) << calls;  // depends on nothing
  EXPECT_FALSE(site.has("out/slurm/shards.sh"));
}

TEST(StudySlurm, AnArrayIsNoLongerThanTheClusterAllows) {
  const Site site;
  site.stand_in("scontrol", "echo 'MaxArraySize            = 3'");  // indices 0, 1, 2
  const Outcome outcome = site.study("--slurm");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(holds(site.read("out/slurm/shards.sh"), "#SBATCH --array=1-2\n"));
  EXPECT_TRUE(holds(outcome.out, "2 tasks at most, each with up to 2 shards")) << outcome.out;
}

TEST(StudySlurm, WithoutSlurmTheScriptsAreThereAndTheCureIsSaid) {
  const Site site;
  for (const char* program : {"sbatch", "scontrol", "squeue"})
    shell(site.folder.path(), std::string("rm bin/") + program);
  // Only what a shell needs is on PATH: a machine on which Slurm is installed takes part, too.
  const Outcome outcome =
      shell(site.folder.path() + "/my 'lab'",
            "PATH=" + site.folder.path() + "/bin '" HYSTERON_PROGRAM "' study job.json -o out --slurm --errors json");
  const auto problem = problem_of(outcome);
  EXPECT_EQ(problem.value("code", ""), "no_slurm");
  EXPECT_TRUE(holds(problem.value("cure", ""), "without --slurm")) << problem;
  EXPECT_TRUE(site.has("out/slurm/shards.sh"));
}

TEST(StudySlurm, WhatSlurmSaysAgainstAScriptIsTold) {
  const Site site;
  site.stand_in("sbatch", "echo 'sbatch: error: Batch job submission failed: Invalid account' >&2; exit 1");
  const auto problem = problem_of(site.study("--slurm --errors json"));
  EXPECT_EQ(problem.value("code", ""), "slurm_refused");
  EXPECT_TRUE(holds(problem.value("what", ""), "Invalid account")) << problem;
  EXPECT_TRUE(holds(problem.value("cure", ""), "--slurm-options")) << problem;
  EXPECT_FALSE(site.has("out/slurm/jobs.txt"));
}

TEST(StudySlurm, IfTheMergeIsRefusedTheShardsAreTakenBack) {
  const Site site;
  site.stand_in("sbatch", "case \"$*\" in *merge*) echo no >&2; exit 1;; *) echo '41;big';; esac");
  EXPECT_EQ(problem_of(site.study("--slurm --errors json")).value("code", ""), "slurm_refused");
  EXPECT_EQ(site.folder.read("scancel_called"), "41\n");
}

TEST(StudySlurm, AStudyThatRunsIsNotSubmittedTwice) {
  const Site site;
  ASSERT_EQ(site.study("--slurm").code, 0);
  site.stand_in("squeue", "echo \"$*\" > $SITE/squeue_called; echo 41_2");
  const auto problem = problem_of(site.study("--slurm --errors json"));
  EXPECT_EQ(problem.value("code", ""), "study_is_running");
  EXPECT_TRUE(holds(site.folder.read("squeue_called"), "--jobs=41,42")) << site.folder.read("squeue_called");
  // Slurm has forgotten the jobs, and says so with an error.
  site.stand_in("squeue", "echo 'slurm_load_jobs error: Invalid job id specified' >&2; exit 1");
  EXPECT_EQ(site.study("--slurm").code, 0);
}

TEST(StudySlurm, ADryRunWritesTheScriptsAndSubmitsNothing) {
  const Site site;
  EXPECT_EQ(site.study("--slurm-dry-run").code, 0);
  EXPECT_EQ(site.calls(), "");
  EXPECT_TRUE(site.has("out/slurm/shards.sh"));
  EXPECT_TRUE(site.has("out/slurm/merge.sh"));
}

TEST(StudySlurm, AnyNameOfAFolderComesThroughTheScripts) {
  for (const std::string name :
       {"o\ntouch broken;#", "$(touch broken)", "`touch broken`", "a'b\"c; touch broken", "./-o", "\t\\n"}) {
    const Folder folder;
    small_study::write(folder, "", 8);
    const Outcome dry =
        hysteron(folder.path(), {"study", "job.json", "-o", name, "--slurm-dry-run", "--slurm-tasks", "1"});
    ASSERT_EQ(dry.code, 0) << dry.err;
    const std::string scripts = folder.path() + "/" + name + "/slurm/";
    for (const char* script : {"shards.sh", "merge.sh"}) {
      fs::copy_file(scripts + script, folder.path() + "/script", fs::copy_options::overwrite_existing);
      const Outcome done = shell(folder.path(), "SLURM_ARRAY_TASK_ID=1 bash script");
      EXPECT_EQ(done.code, 0) << name << done.out << done.err;
    }
    EXPECT_TRUE(folder.has(name + "/study.h5")) << name;
    EXPECT_FALSE(folder.has("broken")) << name;
    // The command by which the user goes there, in the script and on the terminal.
    const std::string text = folder.read("/" + name + "/slurm/shards.sh");
    const auto at = text.find("#   cd ") + 4;
    folder.write("go", text.substr(at, text.find('\n', at) - at) + "\n[ -e merge.sh ]\n");
    EXPECT_EQ(shell(folder.path(), "bash go").code, 0) << name;
  }
}

TEST(StudySlurm, WrongInputIsToldHereAndNotByTheCluster) {
  const Site site;
  for (const char* words :
       {"--slurm --slurm-options --array=1-2", "--slurm --slurm-tasks 0", "--slurm --shard 1/4", "--slurm --merge"})
    EXPECT_EQ(site.study(words).code, 2) << words;
  site.folder.write("my 'lab'/job.json", R"({"format": 1, "do": "study"})");
  EXPECT_EQ(site.study("--slurm").code, 2);
  EXPECT_EQ(site.calls(), "");
}

}  // namespace
}  // namespace hysteron
