// Decides how numbers of runs in lanes lie in memory: rows of Lanes::width doubles. Internal to lanes.cpp.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <new>
#include <utility>

#include "engine/lanes/lanes.h"

namespace hysteron {

/// Numbers on the boundary of a cache line, so that no vector lies across two.
class LaneNumbers {
 public:
  explicit LaneNumbers(int rows)
      : size_(static_cast<std::size_t>(rows) * Lanes::width),
        data_(static_cast<double*>(std::aligned_alloc(64, std::max<std::size_t>(64, size_ * sizeof(double))))) {
    if (!data_) throw std::bad_alloc();
    std::fill_n(data_.get(), size_, 0.0);
  }
  /// The first of the Lanes::width numbers of row i.
  double* row(int i) { return data_.get() + static_cast<std::size_t>(i) * Lanes::width; }
  double* data() { return data_.get(); }
  std::size_t size() const { return size_; }
  void swap(LaneNumbers& other) { data_.swap(other.data_); }

 private:
  struct Free {
    void operator()(double* p) const { std::free(p); }
  };
  std::size_t size_;
  std::unique_ptr<double[], Free> data_;
};

}  // namespace hysteron
