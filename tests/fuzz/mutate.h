// Decides how a good file becomes a bad one: bits, numbers of extreme size, pieces moved, words of its format.
// Does not know formats.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace hysteron::fuzz {

class Mutator {
 public:
  /// The same seed gives the same files. `words` are those of the format; they are put in now and then.
  Mutator(std::uint64_t seed, std::vector<std::string> words) : random_(seed), words_(std::move(words)) {}

  /// `bytes` with one to eight changes, no longer than `longest`; `other` is a file from which pieces may come.
  std::string mutated(std::string bytes, const std::string& other, std::size_t longest);

  /// Below n, which is not 0.
  std::size_t pick(std::size_t n) { return static_cast<std::size_t>(random_() % n); }

 private:
  void change(std::string& bytes, const std::string& other);
  void put_number(std::string& bytes);

  std::mt19937_64 random_;
  std::vector<std::string> words_;
};

}  // namespace hysteron::fuzz
