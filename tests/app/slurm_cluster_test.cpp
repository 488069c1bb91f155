// Studies on a real Slurm: slurmctld and two slurmd on this machine alone (tests/cluster/loopback_cluster). Skipped,
// visibly, where Slurm is not installed.
#include <gtest/gtest.h>

#include "tests/app/hysteron_process.h"

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

}  // namespace
}  // namespace hysteron
