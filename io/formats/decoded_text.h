// Decides how the bytes of a text file become UTF-8: instruments and spreadsheets also write UTF-16 and Latin-1.
#pragma once

#include <string>
#include <string_view>

namespace hysteron {

struct DecodedText {
  std::string text;     ///< UTF-8, without a byte order mark
  std::string assumed;  ///< "UTF-16", "Latin-1"; "" where it was UTF-8 all along
};

/// Never fails: what is no UTF-8 is Latin-1, in which every byte is a character.
DecodedText decoded(std::string_view bytes);

}  // namespace hysteron
