// Studies on a real Slurm: slurmctld and two slurmd on this machine alone (tests/cluster/loopback_cluster). Skipped,
// visibly, where Slurm is not installed.
#include <gtest/gtest.h>

#include "tests/app/hysteron_process.h"
#include "tests/app/small_study.h"

namespace hysteron {
namespace {

using process::Folder;
using process::Outcome;
using process::shell;

const std::string cluster = HYSTERON_SOURCE_DIR "/tests/cluster/loopback_cluster";

/// Runs a command within a cluster of two nodes; its time limit leaves a slow machine ten times what is needed.
Outcome in_cluster(const Folder& folder, const std::string& command) {
  return shell(folder.path(), "LOOPBACK_LOGS=$PWD/logs " + cluster + " --time 400 " + command);
}

#define SKIP_WITHOUT_SLURM(outcome) \
  if ((outcome).code == 77) GTEST_SKIP() << "not tested on a cluster: " << (outcome).err

TEST(LoopbackCluster, RunsAJobAndLeavesNothingBehind) {
  const Folder folder;
  const Outcome outcome = in_cluster(
      folder, R"(bash -c 'sbatch --wait --output=said --wrap "echo on \$SLURMD_NODENAME"; sbatch --wrap "sleep 300";
                          echo $LOOPBACK_CLUSTER > cluster; exit 7')");
  SKIP_WITHOUT_SLURM(outcome);
  EXPECT_EQ(outcome.code, 7) << outcome.err;
  EXPECT_EQ(folder.read("said"), "on node1\n");
  // Daemons and jobs carry the cluster's folder in their environment; neither it nor one of them is left.
  EXPECT_EQ(
      shell(folder.path(), "grep -lzxF LOOPBACK_CLUSTER=$(cat cluster) /proc/[0-9]*/environ 2>/dev/null; true").out,
      "");
  EXPECT_NE(shell(folder.path(), "ls -d $(cat cluster)").code, 0);
}

/// A shard takes about a second: long enough to be hit while it is computed.
constexpr int draws = 4000;

/// The study computed by the plain command, and on the cluster into "the results" while it is disturbed.
struct Disturbed {
  Folder folder;
  Outcome plain, outcome;
  explicit Disturbed(const std::string& manner, const std::string& words = "") {
    small_study::write(folder, "", draws);
    outcome = in_cluster(folder, std::string(HYSTERON_SOURCE_DIR) + "/tests/cluster/disturbed_study " + manner +
                                     " \"$PWD/the results\" hysteron study job.json -o 'the results' --slurm " + words);
    if (outcome.code == 0) plain = shell(folder.path(), "hysteron study job.json -o plain");
  }
  std::string log(const std::string& name) const { return folder.read("the results/slurm/" + name); }
  std::string logs() const { return shell(folder.path(), "tail -n 50 'the results'/slurm/*.log logs/* 2>&1").out; }
};

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// To the bit, and not because there is nothing in it.
void expect_same_study(const Disturbed& d) {
  EXPECT_EQ(d.plain.code, 0) << d.plain.err;
  EXPECT_GT(d.folder.read("plain/study.h5").size(), 1000U);
  EXPECT_TRUE(d.folder.read("the results/study.h5") == d.folder.read("plain/study.h5")) << d.logs();
}

TEST(StudyOnACluster, AShardThatIsKilledIsComputedAgainAndTheMergeWaitsForIt) {
  const Disturbed d("kill");
  SKIP_WITHOUT_SLURM(d.outcome);
  ASSERT_EQ(d.outcome.code, 0) << d.outcome.out << d.outcome.err << d.logs();
  EXPECT_TRUE(holds(d.log("task-2.log"), "shard 2 was killed (signal 9)")) << d.logs();
  EXPECT_TRUE(holds(d.log("task-2.log"), "task 2, start 2")) << d.logs();
  EXPECT_FALSE(holds(d.log("task-1.log"), "start 2")) << d.logs();  // the others were let alone
  expect_same_study(d);
}

TEST(LongStudyOnACluster, AShardWhoseNodeIsLostIsComputedOnAnother) {
  const Disturbed d("lose");
  SKIP_WITHOUT_SLURM(d.outcome);
  ASSERT_EQ(d.outcome.code, 0) << d.outcome.out << d.outcome.err << d.logs();
  EXPECT_TRUE(holds(d.log("task-2.log"), "task 2, start 2")) << d.logs();
  EXPECT_FALSE(holds(d.log("task-2.log"), "was killed")) << d.logs();  // nobody was left to say so
  expect_same_study(d);
}

TEST(LongStudyOnACluster, SeveralShardsOfOneTaskSurviveToo) {
  const Disturbed d("kill", "--slurm-tasks 2");  // shard 4 waits behind shard 2
  SKIP_WITHOUT_SLURM(d.outcome);
  ASSERT_EQ(d.outcome.code, 0) << d.outcome.out << d.outcome.err << d.logs();
  EXPECT_TRUE(holds(d.log("task-2.log"), "task 2, start 2")) << d.logs();
  expect_same_study(d);
}

TEST(LongStudyOnACluster, WhatCannotSucceedIsNotTriedAgainAndTheMergeSaysWhatIsMissing) {
  const Folder folder;
  small_study::write(folder, "", 40);
  // The diagram goes away while the jobs are held; afterwards the same command computes what is missing.
  const Outcome outcome = in_cluster(folder, R"(bash -c '
    ended() { while [[ -n $(squeue --noheader) ]]; do sleep 0.2; done; }
    hysteron study job.json -o out --shard 3/4 || exit 5
    hysteron study job.json -o out --slurm --slurm-options=--hold || exit 6
    mv stage.json away.json
    jobs=$(cat out/slurm/jobs.txt); scontrol release "$jobs"
    ended
    mv away.json stage.json
    cp -r out/slurm first
    hysteron study job.json -o out --slurm || exit 7
    ended')");
  SKIP_WITHOUT_SLURM(outcome);
  ASSERT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  const std::string task = folder.read("first/task-1.log"), merge = folder.read("first/merge.log");
  EXPECT_TRUE(holds(task, "stage.json")) << task;
  EXPECT_FALSE(holds(task, "start 2")) << task;
  EXPECT_TRUE(holds(merge, "task-*.log")) << merge;
  EXPECT_FALSE(folder.has("first/task-3.log"));
  ASSERT_EQ(shell(folder.path(), "hysteron study job.json -o plain").code, 0);
  EXPECT_TRUE(folder.read("out/study.h5") == folder.read("plain/study.h5"));
}

}  // namespace
}  // namespace hysteron
