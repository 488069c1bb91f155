#include "fit/study/sampler.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/random/sobol.hpp>
#include <cmath>

#include "fit/numerics/draws.h"

namespace hysteron {
namespace {

/// Streams of draws.h that no parameter uses.
constexpr std::uint64_t shift_stream = 1ULL << 32;
constexpr std::uint64_t order_stream = 1ULL << 33;

/// 64 random bits in (0, 1), never 0 nor 1.
double unit_interval(std::uint64_t bits) { return (static_cast<double>(bits >> 12) + 0.5) * 0x1p-52; }

double between(const SampledRange& r, double share) {
  if (share <= 0) return r.lower;
  if (share >= 1) return r.upper;
  return r.log ? r.lower * std::pow(r.upper / r.lower, share) : r.lower + share * (r.upper - r.lower);
}

/// The bits of point `i`; boost leaves out the point of zeros, without which the first 2^m points are not balanced
/// (Owen, "On dropping the first Sobol' point", MCQMC 2020).
template <class Put>
void sobol_bits(boost::random::sobol& engine, std::uint64_t i, std::size_t parameters, const Put& put) {
  if (i == 0) {
    for (std::size_t p = 0; p < parameters; ++p) put(p, std::uint64_t{0});
    return;
  }
  engine.seed(i - 1);
  for (std::size_t p = 0; p < parameters; ++p) put(p, static_cast<std::uint64_t>(engine()));
}

std::uint64_t points_of(const SampledRange& r) { return r.values.empty() ? r.points : r.values.size(); }

double grid_value(const SampledRange& r, std::uint64_t k) {
  if (!r.values.empty()) return r.values[k];
  return r.points < 2 ? r.lower : between(r, static_cast<double>(k) / static_cast<double>(r.points - 1));
}

}  // namespace

const std::vector<std::string>& sampling_methods() {
  static const std::vector<std::string> names{"uniform", "latin_hypercube", "sobol", "grid", "list"};
  return names;
}

std::uint64_t shuffled(std::uint64_t i, std::uint64_t n, std::uint64_t key) {
  if (n < 2) return 0;
  int half = 1;  // bits of each half
  while (half < 32 && (std::uint64_t{1} << (2 * half)) < n) ++half;
  const std::uint64_t mask = (std::uint64_t{1} << half) - 1;
  constexpr int rounds = 6;
  do {
    std::uint64_t left = i >> half, right = i & mask;
    for (int round = 0; round < rounds; ++round) {
      const std::uint64_t mixed = draws::mix(key + draws::mix(right * rounds + static_cast<std::uint64_t>(round) + 1));
      const std::uint64_t next = left ^ (mixed & mask);
      left = right;
      right = next;
    }
    i = (left << half) | right;
  } while (i >= n);
  return i;
}

struct Sampler::Sobol {
  explicit Sobol(std::size_t parameters) : engine(parameters) {}
  boost::random::sobol engine;
  std::vector<std::uint64_t> shift{};  ///< per parameter: a random digital shift, which keeps the evenness
};

Sampler::Sampler(SamplingMethod method, std::uint64_t seed, std::uint64_t draws, std::vector<SampledRange> ranges)
    : method_(method), seed_(seed), ranges_(std::move(ranges)) {
  if (method_ == SamplingMethod::latin_hypercube) size_ = draws;
  if (method_ == SamplingMethod::list) size_ = ranges_.empty() ? 0 : ranges_.front().values.size();
  if (method_ == SamplingMethod::grid) {
    size_ = 1;
    for (const auto& r : ranges_) size_ *= points_of(r);
  }
  if (method_ == SamplingMethod::sobol) {
    sobol_ = std::make_unique<Sobol>(ranges_.size());
    for (std::size_t p = 0; p < ranges_.size(); ++p)
      sobol_->shift.push_back(draws::mix(draws::mix(seed_ + shift_stream) + draws::mix(p + 1)));
  }
}

Sampler::Sampler(const Sampler& other)
    : method_(other.method_),
      seed_(other.seed_),
      size_(other.size_),
      ranges_(other.ranges_),
      sobol_(other.sobol_ ? std::make_unique<Sobol>(*other.sobol_) : nullptr) {}
Sampler::Sampler(Sampler&&) noexcept = default;
Sampler& Sampler::operator=(Sampler&&) noexcept = default;
Sampler::~Sampler() = default;

std::string Sampler::description() const {
  std::string text = fmt::format("{} {} {}", sampling_methods()[static_cast<std::size_t>(method_)], seed_, size_);
  for (const auto& r : ranges_) {
    text += fmt::format("; {:a} {:a} {} {}", r.lower, r.upper, r.log, r.points);
    for (const double v : r.values) text += fmt::format(" {:a}", v);
  }
  return text;
}

double Sampler::share(std::uint64_t i, std::size_t parameter) const {
  const double random = draws::uniform(seed_, parameter, i);
  if (method_ == SamplingMethod::uniform) return random;
  const std::uint64_t key = draws::mix(draws::mix(seed_ + order_stream) + draws::mix(parameter + 1));
  return (static_cast<double>(shuffled(i, size_, key)) + random) / static_cast<double>(size_);
}

void Sampler::draw_sobol(std::uint64_t i, std::span<double> values) {
  sobol_bits(sobol_->engine, i, ranges_.size(), [&](std::size_t p, std::uint64_t bits) {
    values[p] = between(ranges_[p], unit_interval(bits ^ sobol_->shift[p]));
  });
}

void Sampler::draw(std::uint64_t i, std::span<double> values) {
  switch (method_) {
    case SamplingMethod::sobol:
      return draw_sobol(i, values);
    case SamplingMethod::list:
      for (std::size_t p = 0; p < ranges_.size(); ++p) values[p] = ranges_[p].values[i];
      return;
    case SamplingMethod::grid:
      for (std::size_t p = ranges_.size(); p-- > 0;) {
        const std::uint64_t points = points_of(ranges_[p]);
        values[p] = grid_value(ranges_[p], i % points);
        i /= points;
      }
      return;
    default:
      for (std::size_t p = 0; p < ranges_.size(); ++p) values[p] = between(ranges_[p], share(i, p));
  }
}

std::vector<double> sobol_point(std::uint64_t i, std::size_t parameters) {
  boost::random::sobol engine(parameters);
  std::vector<double> point(parameters);
  sobol_bits(engine, i, parameters,
             [&](std::size_t p, std::uint64_t bits) { point[p] = std::ldexp(static_cast<double>(bits), -64); });
  return point;
}

}  // namespace hysteron
