// Decides how a block hands a list to a law in plain numbers: as it is where it is plain, else as a copy.
#pragma once

#include <span>
#include <type_traits>
#include <vector>

#include "models/number.h"

namespace hysteron::blocks {

/// The list itself for double, which the hot path takes: nothing is allocated there.
template <class T>
auto plain_list(std::span<const T> list) {
  if constexpr (std::is_same_v<T, double>) {
    return list;
  } else {
    std::vector<double> numbers;
    numbers.reserve(list.size());
    for (const T& x : list) numbers.push_back(plain(x));
    return numbers;
  }
}

}  // namespace hysteron::blocks
