#include "io/json/file_kind.h"

#include <fmt/format.h>

#include "io/files/shell_word.h"

namespace hysteron {
namespace {

const char* words_of(FileKind kind) {
  return kind == FileKind::diagram ? "a diagram" : kind == FileKind::data_set ? "a data set" : "a job";
}

/// What to name in its place, and where this one belongs.
std::string cure_for(FileKind found, FileKind expected, const std::string& file) {
  const std::string word = shell_word(file);
  if (expected == FileKind::job) return "name a job here, a file with \"do\"; it names its diagram and data set itself";
  return found == FileKind::data_set
             ? fmt::format("name a diagram here; a data set goes behind --data: hysteron compare stage.json --data {}",
                           word)
             : fmt::format(
                   "name a recording or a data set here; a diagram comes first: hysteron compare {} --data lab.csv",
                   word);
}

}  // namespace

void check_kind(const JsonPlace& root, FileKind expected) {
  if (!root.is_object() || root.find("do")) return;  // those who read jobs and diagrams say what is wrong with one
  const bool has_blocks = root.find("blocks").has_value(), has_recordings = root.find("recordings").has_value();
  if (has_blocks == has_recordings) return;
  const FileKind found = has_blocks ? FileKind::diagram : FileKind::data_set;
  if (found == expected) return;
  root.add("other_kind", fmt::format("this file is {}, not {}", words_of(found), words_of(expected)),
           cure_for(found, expected, root.file().file()));
  root.file().throw_if_any();
}

}  // namespace hysteron
