// Decides how the small motions of all blocks of a program act together: local slopes (block_slopes.h) along the wires,
// algebraic loops included, with signals moved from outside and loops opened. Internal to the engine: what users see is
// in linearize.h and sampled_model.h.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "engine/analysis/linearize.h"

namespace hysteron {

struct BlockSlopes;

/// What feeds a signal in place of its block: a dead time, or the describing function of a block.
struct Channel {
  int block = -1;
  int source = -1;                  ///< signal that goes in
  int signal = -1;                  ///< that comes out
  double delay = 0;                 ///< [s]
  std::complex<double> factor = 1;  ///< [out/in], at positive frequencies
};

/// Deviations between instants. States z are those of the program less what driven laws take over from w at once
/// (dx/dt = ... + r du/dt), so that z does not jump where w does. w: what sampled blocks hold, then the signals moved
/// from outside, then the outputs of the channels.
struct Flow {
  Eigen::MatrixXd a, b;            ///< dz/dt = a z + b w
  Eigen::MatrixXd seen_z, seen_w;  ///< per signal, as its readers see it
  Eigen::MatrixXd taken;           ///< x = z + taken w
};

/// What an instant makes of the sampled states and held outputs m: m = j (z, m) + k v, v the signals moved from outside
/// and the outputs of the channels.
struct Hit {
  Eigen::MatrixXd j, k;
};

class WiredSlopes {
 public:
  /// Throws Error as LocalSlopes and describing functions do.
  WiredSlopes(const Program& program, const Run& run, const LinearizeOptions& options);
  ~WiredSlopes();
  WiredSlopes(const WiredSlopes&) = delete;
  WiredSlopes& operator=(const WiredSlopes&) = delete;

  Flow flow() const;
  /// `due`: per sampled block (its place in program.sampled_blocks), does it run.
  Hit hit(const Flow& flow, const std::vector<bool>& due) const;

  /// Per state z, sampled state, held output and channel: does it lie on the way from `from` to `to`.
  std::vector<bool> between(const Flow& flow) const;

  int states() const { return n_x_; }
  int sampled_states() const { return n_s_; }
  int held() const { return n_h_; }
  int inputs() const { return static_cast<int>(options_.from.size()); }
  const std::vector<Channel>& channels() const { return channels_; }
  /// Nonlinear blocks that pass nothing on though something arrives from `from` and is awaited at `to`.
  std::vector<int> cuts() const;

 private:
  int columns() const { return n_x_ + n_s_ + n_h_ + inputs() + static_cast<int>(channels_.size()); }
  Eigen::MatrixXd seen(const std::vector<bool>& due) const;
  Eigen::MatrixXd gathered(const Eigen::MatrixXd& seen, int block) const;
  void replace(int block, const std::vector<std::complex<double>>& factors);

  const Program& program_;
  const LinearizeOptions& options_;
  std::vector<BlockSlopes> slopes_;
  std::vector<Channel> channels_;
  std::vector<bool> masked_;            // per signal: its readers do not see what its block does
  std::vector<bool> about_amplitude_;   // per block
  std::vector<bool> off_;               ///< per block: stands in a nested diagram that does not run
  std::vector<int> s_begin_, h_begin_;  // per sampled block
  int n_x_ = 0, n_s_ = 0, n_h_ = 0;
};

}  // namespace hysteron
