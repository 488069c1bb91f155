#include "discover/models/derivative_store.h"

namespace hysteron {

std::shared_ptr<const Dense> DerivativeStore::derivatives_of(const std::string& name) const {
  if (const auto found = derivatives_.find(name); found != derivatives_.end()) return found->second;
  return earlier_ ? earlier_->derivatives_of(name) : nullptr;
}

void DerivativeStore::keep(const std::string& name, std::shared_ptr<const Dense> derivatives) {
  constexpr std::size_t most_numbers = 10'000'000;  // 80 MB: of a step's candidates, of some 1e5 rows
  if (numbers_ + derivatives->a.size() > most_numbers) {
    derivatives_.clear();
    numbers_ = 0;
  }
  auto& here = derivatives_[name];
  numbers_ += derivatives->a.size() - (here ? here->a.size() : 0);
  here = std::move(derivatives);
}

void DerivativeStore::add(const DerivativeStore& later) {
  for (const auto& [name, derivatives] : later.derivatives_) keep(name, derivatives);
  count(later.runs_);
}

}  // namespace hysteron
