// Decides how a test gets C code out of the program and runs it.
#pragma once

#include <string>
#include <vector>

#include "tests/app/hysteron_process.h"

namespace hysteron::in_c {

/// "hysteron export c" with these words, into the folder `out`.
inline process::Outcome exported(const process::Folder& folder, std::vector<std::string> words) {
  words.insert(words.begin(), {"export", "c"});
  words.insert(words.end(), {"-o", "out"});
  return process::hysteron(folder.path(), words);
}

inline constexpr char warnings[] = " -std=c99 -Wall -Wextra -Werror -pedantic ";
/// What is undefined in C, or beyond an array, ends the program.
inline constexpr char sanitized[] =
    " -O1 -g1 -fsanitize=address,undefined,float-cast-overflow -fno-sanitize-recover=all ";

/// What the test of the code says, compiled with every warning an error; its exit code, or that of the compiler.
inline process::Outcome tried(const process::Folder& folder, const std::string& compiler = "cc",
                              const std::string& run = "", const std::string& options = "-O2") {
  return process::shell(folder.path(), "cd out && " + compiler + warnings + options +
                                           " -o comp_test comp_test.c comp.c -lm && " + run + " ./comp_test");
}

inline constexpr char same_bits[] = "rows of the engine: the same bits";

}  // namespace hysteron::in_c
