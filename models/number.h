// Decides how a law reads the plain number behind its scalar, where a step size or a count must not depend on rates
// or parameter directions. Does not decide what scalars there are: value_of is found beside them.
#pragma once

#include <type_traits>

namespace hysteron {

/// The number itself, for double as for scalars that carry derivatives (those have value_of beside them).
template <class T>
double plain(const T& x) {
  if constexpr (std::is_arithmetic_v<T>)
    return static_cast<double>(x);
  else
    return plain(value_of(x));
}

}  // namespace hysteron
