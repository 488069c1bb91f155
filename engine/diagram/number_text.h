// Decides how a text is read as a number: by std::from_chars alone, on every machine and in every locale the same.
// Does not know units (units.h), nor how a number is written.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace hysteron {

/// Reads the number that `text` begins with and returns how many characters it takes; 0 if there is none. One "+" may
/// stand before it. What is beyond the largest double is infinite, what is below the smallest one is zero, both with
/// their sign; subnormal numbers are numbers. "inf" and "nan" are read, too, where the word ends there: whoever asks
/// says whether they will do.
std::size_t read_number(std::string_view text, double& value);

/// The number that the whole text is, read as above; nothing where it is none.
std::optional<double> number_of(std::string_view text);

/// The whole number that `text` begins with; `otherwise` where there is none, or none that an int can hold.
int leading_whole_number(std::string_view text, int otherwise);

/// The nearest number of so many significant digits: what its text with them means.
double rounded_to_digits(double value, int digits);

}  // namespace hysteron
