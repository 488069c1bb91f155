// Decides how names and numbers look in C, and how code in double becomes code in float. Knows no blocks.
#pragma once

#include <functional>
#include <set>
#include <string>

namespace hysteron::c_text {

/// The number in which the code computes.
enum class Real { float64, float32 };

/// A literal that reads back as the same number; of a float the nearest one. Infinite: INFINITY of math.h.
std::string literal(Real real, double value);

/// Names of one scope: words of C and of math.h are taken.
class Names {
 public:
  /// "stage_play" of "stage/play", with something behind it where that is taken.
  std::string take(const std::string& wish);
  void reserve(const std::string& name) { taken_.insert(name); }

 private:
  std::set<std::string> taken_;
};

/// Letters, digits and underscores; no digit in front.
std::string identifier(const std::string& text);

/// Every placeholder "$kind.name" (c_law.h) replaced by what `meaning(kind, name)` says.
std::string filled(const std::string& text,
                   const std::function<std::string(const std::string& kind, const std::string& name)>& meaning);

/// Code written in double, for `real`: "${in double|in float}", types, literals and functions of math.h.
std::string in_numbers(Real real, const std::string& text);

/// Every line that is not empty moved to the right by so many spaces.
std::string indented(const std::string& text, int spaces);

/// The text without what would end a comment.
std::string in_comment(std::string text);

/// Lines of at most 100 characters, broken at blanks, each further one behind `begin`.
std::string wrapped(const std::string& text, const std::string& begin);

}  // namespace hysteron::c_text
