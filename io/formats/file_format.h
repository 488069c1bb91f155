// Decides by which reader a file is read: by what stands in it, never by its name alone. What no reader reads is named
// as what it is, with what to do. A further format is one more line in the table (file_format.cpp).
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "io/formats/measured_table.h"

namespace hysteron {

struct FileFormat {
  bool (*is)(std::string_view bytes);                                ///< judged by the first kilobytes
  MeasuredTable (*read)(const std::string&, const ReadingChoices&);  ///< may throw Error of any input fault
};

/// All that are no plain text, in the order in which they are tried.
std::span<const FileFormat> file_formats();

/// Reads a measured file of any known format. Throws Error "no_file", "is_directory", "empty_file",
/// "unknown_file_type" (named as what it is), and what the reader of its format throws: "no_table", "no_header",
/// "ambiguous_decimal", "bad_number", "row_length" ..., each with the place and the option that chooses.
MeasuredTable read_measured_table(const std::string& file, const ReadingChoices& choices);

/// Whether the file is text: neither a format of numbers as they lie in memory nor anything else that holds zero bytes.
bool is_text_file(const std::string& file);

// The readers, and by what each knows its files: lvm.cpp, xlsx.cpp, mat.cpp, hdf5_recording.cpp, tdms.cpp.
bool is_lvm(std::string_view bytes);
MeasuredTable read_lvm(const std::string& file, const ReadingChoices& choices);
bool is_xlsx(std::string_view bytes);
MeasuredTable read_xlsx(const std::string& file, const ReadingChoices& choices);
bool is_mat(std::string_view bytes);
MeasuredTable read_mat(const std::string& file, const ReadingChoices& choices);
bool is_hdf5(std::string_view bytes);
MeasuredTable read_hdf5(const std::string& file, const ReadingChoices& choices);
bool is_tdms(std::string_view bytes);
MeasuredTable read_tdms(const std::string& file, const ReadingChoices& choices);

/// What the file is where no reader reads it ("a PDF"), and what to do; empty where nobody knows (known_file.cpp).
struct KnownFile {
  std::string what, cure;
};
KnownFile known_file(std::string_view bytes, const std::string& file);

}  // namespace hysteron
