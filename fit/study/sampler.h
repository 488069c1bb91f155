// Decides which values a draw of a study has: draw i is a function of the seed and i alone, so that any part of a study
// can be computed anywhere, in any order. Does not know what the values are used for.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace hysteron {

enum class SamplingMethod {
  uniform,          ///< every draw on its own
  latin_hypercube,  ///< each parameter has exactly one draw in each of as many equal parts as there are draws
  sobol,            ///< low discrepancy: fills the ranges evenly from the first draw on
  grid,             ///< every combination, the last parameter fastest
  list              ///< row by row as given
};

/// In the order of SamplingMethod.
const std::vector<std::string>& sampling_methods();

/// One parameter.
struct SampledRange {
  double lower = 0, upper = 0;
  bool log = false;              ///< evenly in the logarithm; both ends above zero
  std::uint64_t points = 0;      ///< of a grid without `values`
  std::vector<double> values{};  ///< of a list, or of a grid
};

/// Place of `i` in a random order of 0 ... n-1 that belongs to `key`: a Feistel network over the next power of four,
/// walked until it comes back below n. Source: Black, Rogaway, CT-RSA 2002, doi 10.1007/3-540-45760-7_9 (cycle
/// walking).
std::uint64_t shuffled(std::uint64_t i, std::uint64_t n, std::uint64_t key);

/// Copy it for another thread.
class Sampler {
 public:
  /// `draws`: how many there will be; needed by a Latin hypercube alone, a grid and a list know it themselves.
  Sampler(SamplingMethod method, std::uint64_t seed, std::uint64_t draws, std::vector<SampledRange> ranges);
  Sampler(const Sampler& other);
  Sampler& operator=(const Sampler&) = delete;
  Sampler(Sampler&&) noexcept;
  Sampler& operator=(Sampler&&) noexcept;
  ~Sampler();

  std::size_t parameters() const { return ranges_.size(); }
  /// How many draws there are; 0 = as many as are asked for.
  std::uint64_t size() const { return size_; }
  /// All that decides its draws, as text.
  std::string description() const;
  /// Values of draw `i`, one per parameter.
  void draw(std::uint64_t i, std::span<double> values);

 private:
  struct Sobol;
  double share(std::uint64_t i, std::size_t parameter) const;
  void draw_sobol(std::uint64_t i, std::span<double> values);

  SamplingMethod method_;
  std::uint64_t seed_, size_ = 0;
  std::vector<SampledRange> ranges_;
  std::unique_ptr<Sobol> sobol_;
};

/// Most parameters that a Sobol sequence has (the direction numbers of Joe and Kuo, as boost holds them).
inline constexpr std::size_t most_sobol_parameters = 3667;

/// Point `i` of the Sobol sequence as it stands in the literature, from (0, 0, ...) on, without a random shift.
std::vector<double> sobol_point(std::uint64_t i, std::size_t parameters);

}  // namespace hysteron
