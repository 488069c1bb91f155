// Decides how a word is written so that a shell reads it back as it is: in scripts, in their comments, in commands that
// the user is told to give. Does not know what the word means.
#pragma once

#include <string>

namespace hysteron {

/// One word of bash, on one line, whatever stands in it: as it is where nothing in it means anything to a shell, else
/// in quotes.
std::string shell_word(const std::string& word);

/// A newline, a tab and the like.
inline bool is_control(char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; }

}  // namespace hysteron
