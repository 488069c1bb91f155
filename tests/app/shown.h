// Decides how tests read what a page shows (README.md, docs/): its files, its commands, what these print; and how they
// do it. Does not know what a page should say.
#pragma once

#include <string>
#include <vector>

#include "tests/app/hysteron_process.h"

namespace hysteron::shown {

/// A block between lines of ```; `language` is the rest of the first of them.
struct Fence {
  std::string language;
  std::string text;
};

std::vector<Fence> fences_of(const std::string& file);

/// What a page shows of an output: its lines without the "..." that stand for more.
std::vector<std::string> lines_of_output(const std::string& text);

/// Does what a page shows: a block "json NAME" (or "json", where `name_of_first` says how the first one is called) is
/// the file NAME; each block of commands runs behind all that stands above it, and prints what the block of text below
/// it shows. Returns how many blocks of commands there were.
int do_as_shown(const std::string& page, const process::Folder& folder, const std::string& name_of_first = "");

/// The command lines of a page that begin with "hysteron": of its blocks, and of its lines that begin with four blanks.
/// A line that ends with a backslash goes on in the next one.
std::vector<std::string> commands_of(const std::string& page);

/// The words of such a line as a shell would make them, up to a comment, a pipe or what else ends a command, or three
/// blanks; without "hysteron" itself.
std::vector<std::string> words_of(const std::string& command);

}  // namespace hysteron::shown
