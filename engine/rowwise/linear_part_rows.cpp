// The linear part row after row: everything that does not change from row to row is laid out once, in the order in
// which it is read. The states of up to twelve are kept in pairs, with which processors calculate at once; sums of even
// and odd columns stand side by side, so that none waits for all before it.
#include <algorithm>
#include <array>
#include <cstring>
#include <span>

#include "engine/diagram/index.h"
#include "engine/rowwise/linear_part.h"

namespace hysteron {
namespace {

using Pair [[gnu::vector_size(16)]] = double;

inline Pair pair_at(const double* from) {
  Pair p;
  std::memcpy(&p, from, sizeof p);
  return p;
}
inline Pair twice(double a) { return Pair{a, a}; }

/// next = diagonal x + sum of the columns times their factors; eight rows at a time, whose sums stay in registers.
/// `columns`: the diagonal, behind it the columns, all of n numbers, a multiple of eight.
void sum_columns(std::size_t n, const double* columns, std::span<const double> factors, const double* x, double* next) {
  constexpr std::size_t pairs = 4;
  for (std::size_t row = 0; row < n; row += 2 * pairs) {
    const double* column = columns + row;
    std::array<Pair, pairs> sum;
    for (std::size_t j = 0; j < pairs; ++j) sum[j] = pair_at(column + 2 * j) * pair_at(x + row + 2 * j);
    for (const double f : factors) {
      column += n;
      const Pair factor = twice(f);
      for (std::size_t j = 0; j < pairs; ++j) sum[j] += pair_at(column + 2 * j) * factor;
    }
    std::memcpy(next + row, sum.data(), sizeof sum);
  }
}

double product(std::size_t n, const double* a, const double* b) {
  Pair even{}, odd{};
  for (std::size_t i = 0; i < n; i += 4) {
    even += pair_at(a + i) * pair_at(b + i);
    odd += pair_at(a + i + 2) * pair_at(b + i + 2);
  }
  even += odd;
  return even[0] + even[1];
}

}  // namespace

void LinearPart::make_packed(int kind, double h) {
  if (packed_.size() <= at(kind)) packed_.resize(at(kind) + 1);
  Packed& p = packed_[at(kind)];
  if (!p.numbers.empty() && p.h == h) return;
  if (p.numbers.empty()) ++packed_count_;
  const Step s = make_step(a_(seen_, seen_), b_(seen_, Eigen::all), h);
  p.h = h;
  const bool apart = seen_.size() > most_in_registers;
  p.numbers.assign(padded_ * (1 + 2 * inputs_.size() + (apart ? 1 + mixing_.size() : seen_.size())), 0.0);
  std::size_t column = 0;
  const auto add = [&](const auto& numbers) {
    for (Eigen::Index i = 0; i < numbers.size(); ++i)
      p.numbers[column * padded_ + static_cast<std::size_t>(i)] = numbers(i);
    ++column;
  };
  if (apart) {
    Eigen::VectorXd own = s.state.diagonal();
    for (const int i : mixing_) own(i) = 0;
    add(own);
  }
  add(s.input.col(s.input.cols() - 1));
  for (Eigen::Index i = 0; i + 1 < s.input.cols(); ++i) {
    add(s.input.col(i) - s.ramp.col(i));
    add(s.ramp.col(i));
  }
  if (apart)
    for (const int i : mixing_) add(s.state.col(i));
  else
    for (Eigen::Index i = 0; i < s.state.cols(); ++i) add(s.state.col(i));
}

template <int size>
void LinearPart::pass_of(const RowsOfPart& rows) {
  constexpr int pairs = (size + 1) / 2, padded = 2 * pairs;
  const std::size_t inputs = inputs_.size(), outputs = outputs_.size();
  std::array<double, padded> start{};
  for (int i = 0; i < size; ++i) start[at(i)] = x_[seen_[at(i)]];
  std::array<Pair, pairs> x;
  for (int j = 0; j < pairs; ++j) x[at(j)] = pair_at(start.data() + 2 * j);
  for (int k = 0; k < rows.count; ++k) {
    const std::ptrdiff_t place = k * rows.stride;
    if (const int kind = rows.kind[k]; kind >= 0) {
      const double* column = packed_[at(kind)].numbers.data();
      std::array<Pair, pairs> even, odd{};
      for (int j = 0; j < pairs; ++j) even[at(j)] = pair_at(column + 2 * j);
      column += padded;
      for (std::size_t i = 0; i < inputs; ++i, column += 2 * padded) {
        const Pair before = twice(rows.w[i][place - rows.stride]), now = twice(rows.w[i][place]);
        for (int j = 0; j < pairs; ++j)
          even[at(j)] += pair_at(column + 2 * j) * before + pair_at(column + padded + 2 * j) * now;
      }
      for (int i = 0; i < size; ++i, column += padded) {
        const Pair state = twice(x[at(i / 2)][i % 2]);
        auto& sum = i % 2 == 0 ? even : odd;
        for (int j = 0; j < pairs; ++j) sum[at(j)] += pair_at(column + 2 * j) * state;
      }
      for (int j = 0; j < pairs; ++j) x[at(j)] = even[at(j)] + odd[at(j)];
    }
    for (std::size_t o = 0; o < outputs; ++o) {
      const double* d = d_rows_.data() + o * (inputs + 1);
      const double* c = c_rows_.data() + o * padded;
      double direct = d[inputs];
      for (std::size_t i = 0; i < inputs; ++i) direct += d[i] * rows.w[i][place];
      Pair sum = pair_at(c) * x[0];
      for (int j = 1; j < pairs; ++j) sum += pair_at(c + 2 * j) * x[at(j)];
      rows.y[o][place] = direct + (sum[0] + sum[1]);
    }
  }
  for (int i = 0; i < size; ++i) x_[seen_[at(i)]] = x[at(i / 2)][i % 2];
}

/// Any number of states, none included. Of many most move none but themselves (each element of a creep): of these the
/// diagonal is enough.
void LinearPart::pass_large(const RowsOfPart& rows) {
  const std::size_t n = seen_.size(), inputs = inputs_.size(), outputs = outputs_.size();
  double* x = row_scratch_.data();
  double* next = x + padded_;
  factors_.assign(1 + 2 * inputs + mixing_.size(), 1.0);
  for (std::size_t i = 0; i < n; ++i) x[i] = x_[seen_[i]];
  for (int k = 0; k < rows.count; ++k) {
    const std::ptrdiff_t place = k * rows.stride;
    if (const int kind = rows.kind[k]; kind >= 0 && n > 0) {
      double* factor = factors_.data() + 1;
      for (std::size_t i = 0; i < inputs; ++i) {
        *factor++ = rows.w[i][place - rows.stride];
        *factor++ = rows.w[i][place];
      }
      for (const int i : mixing_) *factor++ = x[i];
      sum_columns(padded_, packed_[at(kind)].numbers.data(), factors_, x, next);
      std::swap(x, next);
    }
    for (std::size_t o = 0; o < outputs; ++o) {
      const double* d = d_rows_.data() + o * (inputs + 1);
      const double* c = c_rows_.data() + o * padded_;
      double direct = d[inputs];
      for (std::size_t i = 0; i < inputs; ++i) direct += d[i] * rows.w[i][place];
      rows.y[o][place] = n > 0 ? direct + product(padded_, c, x) : direct;
    }
  }
  for (std::size_t i = 0; i < n; ++i) x_[seen_[i]] = x[i];
}

void LinearPart::forget_many_steps() {
  if (packed_count_ <= most_steps_kept) return;
  for (auto& p : packed_) p = {};
  packed_count_ = 0;
}

void LinearPart::pass(const RowsOfPart& rows) {
  forget_many_steps();
  if (!seen_.empty())
    for (int k = 0, last = -1; k < rows.count; ++k)
      if (const int kind = rows.kind[k]; kind >= 0 && kind != last) {
        make_packed(kind, (*rows.lengths)[at(kind)] / rows.substeps);
        last = kind;
      }
  switch (seen_.size()) {
    case 1:
      return pass_of<1>(rows);
    case 2:
      return pass_of<2>(rows);
    case 3:
      return pass_of<3>(rows);
    case 4:
      return pass_of<4>(rows);
    case 5:
      return pass_of<5>(rows);
    case 6:
      return pass_of<6>(rows);
    case 7:
      return pass_of<7>(rows);
    case 8:
      return pass_of<8>(rows);
    case 9:
      return pass_of<9>(rows);
    case 10:
      return pass_of<10>(rows);
    case 11:
      return pass_of<11>(rows);
    case 12:
      return pass_of<12>(rows);
    default:
      return pass_large(rows);
  }
}

}  // namespace hysteron
