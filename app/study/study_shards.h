// Decides how the shards of a study lie on the disk: out/shards/3-of-16.h5, each whole or not there, each knowing which
// study it belongs to. Computes those that are missing. Does not merge them (study_merge.h).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fit/study/study.h"
#include "io/data/column_file.h"

namespace hysteron {

/// `unsealed`: finished by an earlier version, whose files do not show whether they have changed since.
enum class ShardState { absent, finished, unsealed, other_study, damaged };
inline bool can_be_merged(ShardState s) { return s == ShardState::finished || s == ShardState::unsealed; }

/// Where the work stands, for whoever shows it.
struct StudyProgress {
  int shards = 0, finished = 0;
  std::uint64_t draws = 0, accepted = 0;  ///< of the shards that are being computed now, and those finished since
};

class StudyFolder {
 public:
  /// `job`: digest of everything that decides the numbers. `shards`: in how many the study is cut.
  StudyFolder(std::string folder, const Study& study, std::string job, int shards);

  /// Throws Error "folder_in_use" where the folder holds something that is no study; makes nothing.
  void check() const;
  /// Makes the folder. Returns true if shards of another job or another diagram may lie in it. Throws as check() does.
  bool open() const;

  int shards() const { return shards_; }
  const std::string& job() const { return job_; }
  const std::string& path() const { return folder_; }
  std::string file(const std::string& name) const { return folder_ + "/" + name; }
  std::string shard_file(int shard) const;  ///< from 0
  /// Reads all of the shard.
  ShardState state(int shard) const;

  /// Computes a shard and writes it. `go_on` as in compute_shard(); false if it ended it: then nothing is written.
  bool compute(int shard, const std::function<bool(const StudyCounts&)>& go_on) const;
  /// Computes these shards on several threads; `show` is called every now and then by the calling thread. Throws
  /// Interrupted where it is asked to stop (engine/diagram/stop.h), saying what is kept: those that were `there` of the
  /// ones that are wanted, and new ones.
  void compute(const std::vector<int>& shards, std::size_t there, int threads,
               const std::function<void(const StudyProgress&)>& show) const;
  /// Removes what killed processes left.
  void clean() const;

 private:
  std::string folder_;
  const Study& study_;
  std::string job_;
  int shards_;
};

/// Columns of a shard: draw, accepted (where all are kept), then those of the study.
std::vector<ColumnHead> study_heads(const Study& study);
/// Counts as facts of a file, and back. Histograms, too.
void add_counts(const StudyCounts& counts, FileFacts& facts);
StudyCounts read_counts(const Study& study, const ColumnReader& file);

}  // namespace hysteron
