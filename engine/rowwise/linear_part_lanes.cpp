// The linear part row after row in several runs side by side: each number is one of four lanes, with which processors
// calculate at once, and no lane waits for what the row before it made in another. Sums are formed in the order of
// linear_part_rows.cpp, so that a run gives the same numbers alone and beside others.
#include <algorithm>
#include <array>
#include <cstring>

#include "engine/block/kernel.h"
#include "engine/rowwise/linear_part.h"

namespace hysteron {
namespace {

constexpr std::size_t lanes = static_cast<std::size_t>(RowsView::most_lanes);
using Four [[gnu::vector_size(lanes * sizeof(double))]] = double;

[[gnu::always_inline]] inline void load(Four& to, const double* from) { std::memcpy(&to, from, sizeof to); }

/// What a pass reads and writes: matrices and states with four lanes to a number.
struct Lanes {
  const std::vector<double>* const* numbers = nullptr;  ///< per kind: columns as in LinearPart::Packed
  const double *c = nullptr, *d = nullptr;              ///< per output: states, then inputs and one
  double* x = nullptr;
  std::size_t inputs = 0, outputs = 0;
};

template <std::size_t size>
[[gnu::always_inline]] inline void advance(const double* column, const double* const* w, std::ptrdiff_t place,
                                           std::size_t inputs, std::array<Four, size>& x) {
  std::array<Four, size> even, odd{};
  Four number, before, now;
  for (std::size_t j = 0; j < size; ++j) load(even[j], column + j * lanes);
  column += size * lanes;
  for (std::size_t i = 0; i < inputs; ++i, column += 2 * size * lanes) {
    load(before, w[i] + place - static_cast<std::ptrdiff_t>(lanes));
    load(now, w[i] + place);
    for (std::size_t j = 0; j < size; ++j) {
      Four ramp;
      load(number, column + j * lanes);
      load(ramp, column + (size + j) * lanes);
      even[j] += number * before + ramp * now;
    }
  }
  for (std::size_t i = 0; i < size; ++i, column += size * lanes)
    for (std::size_t j = 0; j < size; ++j) {
      load(number, column + j * lanes);
      (i % 2 == 0 ? even : odd)[j] += number * x[i];
    }
  for (std::size_t j = 0; j < size; ++j) x[j] = even[j] + odd[j];
}

template <std::size_t size>
[[gnu::always_inline]] inline void pass(const Lanes& part, const LinearPart::RowsOfPart& rows) {
  std::array<Four, size> x;
  Four number, input;
  for (std::size_t j = 0; j < size; ++j) load(x[j], part.x + j * lanes);
  for (int k = 0; k < rows.count; ++k) {
    const std::ptrdiff_t place = k * static_cast<std::ptrdiff_t>(lanes);
    if (const int kind = rows.kind[k]; kind >= 0)
      advance<size>(part.numbers[kind]->data(), rows.w, place, part.inputs, x);
    for (std::size_t o = 0; o < part.outputs; ++o) {
      const double* d = part.d + o * (part.inputs + 1) * lanes;
      const double* c = part.c + o * size * lanes;
      Four direct;
      load(direct, d + part.inputs * lanes);
      for (std::size_t i = 0; i < part.inputs; ++i) {
        load(number, d + i * lanes);
        load(input, rows.w[i] + place);
        direct += number * input;
      }
      std::array<Four, 2> sum{};
      for (std::size_t j = 0; j < size; ++j) {
        load(number, c + j * lanes);
        sum[j % 2] += number * x[j];
      }
      direct += sum[0] + sum[1];
      std::memcpy(rows.y[o] + place, &direct, sizeof direct);
    }
  }
  for (std::size_t j = 0; j < size; ++j) std::memcpy(part.x + j * lanes, &x[j], sizeof x[j]);
}

[[gnu::always_inline]] inline void pass_of(std::size_t size, const Lanes& part, const LinearPart::RowsOfPart& rows) {
  if (size <= 1) return pass<1>(part, rows);
  if (size <= 2) return pass<2>(part, rows);
  if (size <= 3) return pass<3>(part, rows);
  if (size <= 4) return pass<4>(part, rows);
  if (size <= 6) return pass<6>(part, rows);
  if (size <= 8) return pass<8>(part, rows);
  if (size <= 10) return pass<10>(part, rows);
  pass<12>(part, rows);
}

void pass_plain(std::size_t size, const Lanes& part, const LinearPart::RowsOfPart& rows) { pass_of(size, part, rows); }

// No fused multiplication: it would round otherwise than other processors do.
[[gnu::target("avx2"), gnu::optimize("fp-contract=off")]] void pass_avx2(std::size_t size, const Lanes& part,
                                                                         const LinearPart::RowsOfPart& rows) {
  pass_of(size, part, rows);
}

/// As pass_of() rounds it up.
std::size_t padded(std::size_t size) { return size <= 1 ? 1 : size <= 4 ? size : size + size % 2; }

}  // namespace

bool LinearPart::pass_lanes(std::span<LinearPart* const> parts, const RowsOfPart& rows) {
  std::size_t most = 0;
  for (const auto* part : parts) most = std::max(most, part->seen_.size());
  if (most > most_in_registers) return false;
  for (auto* part : parts) part->forget_many_steps();
  const LinearPart& first = *parts.front();
  const std::size_t n = padded(most), inputs = first.inputs_.size(), outputs = first.outputs_.size();
  const auto part_of = [&](std::size_t lane) -> LinearPart& { return *parts[lane < parts.size() ? lane : 0]; };

  std::vector<std::vector<double>> made(rows.lengths->size());
  std::vector<const std::vector<double>*> numbers(made.size());
  for (int k = 0; k < rows.count; ++k) {
    const int kind = rows.kind[k];
    if (kind < 0) continue;
    auto& four = made[static_cast<std::size_t>(kind)];
    if (!four.empty()) continue;
    const std::size_t columns = 1 + 2 * inputs + n;
    four.assign(columns * n * lanes, 0.0);
    for (std::size_t l = 0; l < lanes; ++l) {
      LinearPart& part = part_of(l);
      part.make_packed(kind, (*rows.lengths)[static_cast<std::size_t>(kind)] / rows.substeps);
      const auto& own = part.packed_[static_cast<std::size_t>(kind)].numbers;
      const std::size_t of_part = part.seen_.size();
      for (std::size_t column = 0; column < 1 + 2 * inputs + of_part; ++column)
        for (std::size_t j = 0; j < of_part; ++j) four[(column * n + j) * lanes + l] = own[column * part.padded_ + j];
    }
    numbers[static_cast<std::size_t>(kind)] = &four;
  }
  std::vector<double> c(outputs * n * lanes, 0.0), d(outputs * (inputs + 1) * lanes), x(n * lanes, 0.0);
  for (std::size_t l = 0; l < lanes; ++l) {
    const LinearPart& part = part_of(l);
    for (std::size_t o = 0; o < outputs; ++o) {
      for (std::size_t j = 0; j < part.seen_.size(); ++j)
        c[(o * n + j) * lanes + l] = part.c_rows_[o * part.padded_ + j];
      for (std::size_t i = 0; i <= inputs; ++i)
        d[(o * (inputs + 1) + i) * lanes + l] = part.d_rows_[o * (inputs + 1) + i];
    }
    for (std::size_t j = 0; j < part.seen_.size(); ++j) x[j * lanes + l] = part.x_[part.seen_[j]];
  }
  const Lanes all{numbers.data(), c.data(), d.data(), x.data(), inputs, outputs};
  static const bool wide = __builtin_cpu_supports("avx2");
  wide ? pass_avx2(n, all, rows) : pass_plain(n, all, rows);
  for (std::size_t l = 0; l < parts.size(); ++l)
    for (std::size_t j = 0; j < parts[l]->seen_.size(); ++j) parts[l]->x_[parts[l]->seen_[j]] = x[j * lanes + l];
  return true;
}

}  // namespace hysteron
