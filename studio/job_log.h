// Decides what is read out of the error stream of a job: how far it is, and why it failed (docs/programs.md).
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace hysteron::studio {

/// The end of a log, read again as it grows.
class LogTail {
 public:
  void read(const std::string& file);
  double fraction() const { return fraction_; }  ///< -1 where nobody knows
  const std::string& what() const { return what_; }
  double seconds_left() const { return seconds_left_; }  ///< -1 where nobody knows
  /// {"exit_code", "problems"}, or null.
  nlohmann::json failure() const;

 private:
  std::uintmax_t size_ = 0;
  double fraction_ = -1, seconds_left_ = -1;
  std::string what_, tail_;
};

}  // namespace hysteron::studio
