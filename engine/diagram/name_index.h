// Decides where a name stands in a list that holds the names itself: a table of hashes, so that a name among many costs
// no more than one among few. Does not keep names: whoever asks says which one stands at a place.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>
#include <vector>

namespace hysteron {

/// Places by name. `name_at(place)` in all its functions is the name at a place of the list, as a std::string_view.
/// Short lists are compared one by one, for which nothing is kept.
class NameIndex {
 public:
  NameIndex() = default;
  NameIndex(const NameIndex& other) : slots_(other.slots_ ? std::make_unique<Slots>(*other.slots_) : nullptr) {}
  NameIndex(NameIndex&&) noexcept = default;
  NameIndex& operator=(const NameIndex& other) { return *this = NameIndex(other); }
  NameIndex& operator=(NameIndex&&) noexcept = default;
  ~NameIndex() = default;

  /// The first place below `size` with this name; -1 if there is none.
  template <class NameAt>
  std::ptrdiff_t find(std::string_view name, std::size_t size, NameAt name_at) const {
    if (!slots_) {
      for (std::size_t place = 0; place < size; ++place)
        if (name_at(place) == name) return static_cast<std::ptrdiff_t>(place);
      return -1;
    }
    const std::uint32_t slot = (*slots_)[slot_of(name, name_at)];
    return slot == empty ? -1 : static_cast<std::ptrdiff_t>(slot);
  }

  /// The list has grown by one name, which is its last, and now has `size` of them.
  template <class NameAt>
  void added(std::size_t size, NameAt name_at) {
    if (size <= most_compared) return;
    if (!slots_ || 2 * size > slots_->size()) return rebuild(size, name_at);
    put(size - 1, name_at);
  }

  /// The list has changed anywhere else.
  template <class NameAt>
  void rebuild(std::size_t size, NameAt name_at) {
    slots_.reset();
    if (size <= most_compared) return;
    std::size_t slots = 64;
    while (slots < 3 * size) slots *= 2;
    slots_ = std::make_unique<Slots>(slots, empty);
    for (std::size_t place = 0; place < size; ++place) put(place, name_at);
  }

 private:
  using Slots = std::vector<std::uint32_t>;  // a power of two of them, at most half of them taken
  static constexpr std::uint32_t empty = UINT32_MAX;
  static constexpr std::size_t most_compared = 12;  // about where hashing begins to pay

  /// Where a name stands, or would.
  template <class NameAt>
  std::size_t slot_of(std::string_view name, NameAt name_at) const {
    const std::size_t mask = slots_->size() - 1;
    std::size_t slot = std::hash<std::string_view>{}(name)&mask;
    while ((*slots_)[slot] != empty && name_at((*slots_)[slot]) != name) slot = (slot + 1) & mask;
    return slot;
  }

  /// Of names that stand twice the first one counts.
  template <class NameAt>
  void put(std::size_t place, NameAt name_at) {
    std::uint32_t& slot = (*slots_)[slot_of(name_at(place), name_at)];
    if (slot == empty) slot = static_cast<std::uint32_t>(place);
  }

  std::unique_ptr<Slots> slots_;
};

}  // namespace hysteron
