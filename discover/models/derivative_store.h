// Decides what the fits of a discovery leave to later ones. Internal to discover.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "fit/numerics/dense.h"

namespace hysteron {

/// The derivatives that fits have found last, by the names of these: a further effect beside the others hardly changes
/// them. And how many simulations they took.
class DerivativeStore {
 public:
  DerivativeStore() = default;
  /// Of fits that run beside others: they know what stands in `earlier`, to which nobody writes meanwhile, and write
  /// here.
  explicit DerivativeStore(std::shared_ptr<const DerivativeStore> earlier) : earlier_(std::move(earlier)) {}

  /// Null where that was not fitted, or long ago.
  std::shared_ptr<const Dense> derivatives_of(const std::string& name) const;
  void keep(const std::string& name, std::shared_ptr<const Dense> derivatives);
  void count(long runs) { runs_ += runs; }
  long runs() const { return runs_; }
  /// What was written into `later`.
  void add(const DerivativeStore& later);

 private:
  std::shared_ptr<const DerivativeStore> earlier_;
  std::map<std::string, std::shared_ptr<const Dense>> derivatives_;
  std::size_t numbers_ = 0;
  long runs_ = 0;
};

}  // namespace hysteron
