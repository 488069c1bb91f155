#include "io/formats/file_format.h"

#include <fmt/format.h>

#include <fstream>

#include "engine/diagram/error.h"
#include "io/files/atomic_file.h"
#include "io/formats/decoded_text.h"
#include "io/formats/delimited_text.h"

namespace hysteron {
namespace {

constexpr std::size_t bytes_of_a_begin = 8192;

constexpr FileFormat formats[] = {
    {is_lvm, read_lvm}, {is_xlsx, read_xlsx}, {is_mat, read_mat}, {is_hdf5, read_hdf5}, {is_tdms, read_tdms}};

std::string begin_of_file(const std::string& file) {
  check_readable(file);
  std::ifstream in(file, std::ios::binary);
  std::string bytes(bytes_of_a_begin, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, in.gcount())));
  return bytes;
}

bool is_text(const std::string& begin) { return decoded(begin).text.find('\0') == std::string::npos; }

}  // namespace

std::span<const FileFormat> file_formats() { return formats; }

bool is_text_file(const std::string& file) { return is_text(begin_of_file(file)); }

MeasuredTable read_measured_table(const std::string& file, const ReadingChoices& choices) {
  const std::string begin = begin_of_file(file);
  for (const auto& format : formats)
    if (format.is(begin)) return format.read(file, choices);
  const KnownFile known = known_file(begin, file);
  const auto refuse = [&](const std::string& what, const std::string& cure) {
    throw Error(Fault::input, {{"unknown_file_type", file, what, cure, file, 0}});
  };
  if (!known.what.empty())
    refuse(fmt::format("this is {}, not a recording that hysteron reads", known.what), known.cure);
  if (!is_text(begin))
    refuse("this is neither text nor a binary format that hysteron reads",
           "export the recording as CSV with a header such as t [s],u [V],y [um]");
  return read_delimited_text(file, choices);
}

}  // namespace hysteron
