// Decides the closed-form inverse of a Prandtl-Ishlinskii model: another model of the same kind, driven by the output
// of the first. Does not advance it: prandtl_ishlinskii.h does.
#pragma once

#include <cstddef>
#include <span>

namespace hysteron::prandtl_ishlinskii {

/// Number of thresholds up to which all slopes m_j = c_0 + ... + c_j are positive; all of them = the inverse exists,
/// provided that the thresholds increase from 0 (the linear part).
template <class T>
std::size_t rising_slopes(std::span<const T> weights) {
  T slope{0};
  for (std::size_t j = 0; j < weights.size(); ++j) {
    slope += weights[j];
    if (!(slope > T{0})) return j;
  }
  return weights.size();
}

/// r'_j = sum_{i<=j} c_i (r_j - r_i): output of the virgin branch at the threshold, in the unit of y.
/// Source: thesis Eq. 2.13, sums from the linear part on; Kuhnen, Eur. J. Control 9 (2003) 407-418.
template <class T>
void inverse_thresholds(std::span<const T> thresholds, std::span<const T> weights, T* inverse) {
  T slope{0}, reached{0};
  for (std::size_t j = 0; j < thresholds.size(); ++j) {
    if (j > 0) reached += slope * (thresholds[j] - thresholds[j - 1]);
    slope += weights[j];
    inverse[j] = reached;
  }
}

/// c'_0 = 1/c_0, c'_j = 1/m_j - 1/m_(j-1) = -c_j/(m_j m_(j-1)), in u per y.
/// Source: thesis Eqs. 2.8, 2.14 with the sign corrected; Kuhnen as above.
template <class T>
void inverse_weights(std::span<const T> weights, T* inverse) {
  T slope{0};
  for (std::size_t j = 0; j < weights.size(); ++j) {
    const T before = slope;
    slope += weights[j];
    inverse[j] = j == 0 ? T{T{1} / slope} : T{-weights[j] / (slope * before)};
  }
}

/// sum c'_j w'_j over the advanced operators of the inverse; weights are those of the model.
template <class T>
T inverse_output(std::span<const T> weights, std::span<const T> operators) {
  T u{0}, slope{0}, compliance{0};
  for (std::size_t j = 0; j < weights.size(); ++j) {
    slope += weights[j];
    const T next = T{1} / slope;
    u += (next - compliance) * operators[j];
    compliance = next;
  }
  return u;
}

/// w'_j = m_j w_j + sum_{i>j} c_i w_i: memory of the inverse that belongs to memory w of the model, in the unit of y.
/// The memory must be nested: |w_i - w_(i+1)| <= r_(i+1) - r_i, for one-sided operators also w_i >= w_(i+1); any
/// memory that an input has left is. Source: Kuhnen as above (the thesis gives none).
template <class T>
void inverse_memory(std::span<const T> weights, std::span<const T> memory, T* inverse) {
  T beyond{0};
  for (std::size_t j = 0; j < weights.size(); ++j) beyond += weights[j] * memory[j];
  T slope{0};
  for (std::size_t j = 0; j < weights.size(); ++j) {
    slope += weights[j];
    beyond -= weights[j] * memory[j];
    inverse[j] = slope * memory[j] + beyond;
  }
}

}  // namespace hysteron::prandtl_ishlinskii
