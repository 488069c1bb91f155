// Decides what a file is that no reader reads, and what its owner can do.
#include <algorithm>
#include <array>
#include <filesystem>

#include "io/formats/cells.h"
#include "io/formats/file_format.h"

namespace hysteron {
namespace {

struct Signature {
  std::size_t at;
  std::string_view bytes;
  const char* what;
  const char* cure;
};

using namespace std::string_view_literals;

constexpr char export_cure[] = "export the recording as CSV with a header such as t [s],u [V],y [um]";

constexpr Signature signatures[] = {
    {0, "%PDF-"sv, "a PDF", "ask for the numbers themselves, as CSV"},
    {0, "\x89PNG"sv, "a picture (PNG)", "export the numbers behind it as CSV"},
    {0, "\xFF\xD8\xFF"sv, "a picture (JPEG)", "export the numbers behind it as CSV"},
    {0, "GIF8"sv, "a picture (GIF)", "export the numbers behind it as CSV"},
    {0, "BM"sv, "a picture (BMP)", "export the numbers behind it as CSV"},
    {0, "\xD0\xCF\x11\xE0"sv, "an old Excel workbook (xls), or another old Office document",
     "save it as xlsx, or as CSV UTF-8"},
    {0, "\x1F\x8B"sv, "a gzip archive", "unpack it (gunzip) and name what is in it"},
    {0, "BZh"sv, "a bzip2 archive", "unpack it and name what is in it"},
    {0, "7z\xBC\xAF"sv, "a 7-Zip archive", "unpack it and name what is in it"},
    {0,
     "\xFD"
     "7zXZ"sv,
     "an xz archive", "unpack it and name what is in it"},
    {0, "Rar!"sv, "a RAR archive", "unpack it and name what is in it"},
    {0, "MDF     "sv, "an ASAM MDF measurement", "export its channels as CSV (asammdf: mdf.export(\"csv\"))"},
    {0, "PAR1"sv, "a Parquet table", "write it as CSV (pandas: read_parquet(...).to_csv(...))"},
    {0, "\x93NUMPY"sv, "a NumPy array", "write it as CSV (numpy.savetxt with header=\"t [s],u [V]\", delimiter=\",\")"},
    {0, "SQLite format 3"sv, "an SQLite database", "export the table as CSV"},
    {0, "WAVEDESC"sv, "a binary LeCroy trace", "save the trace as ASCII/CSV on the instrument"},
    {0, "#9"sv, "a binary block of an instrument (SCPI)", "save the waveform as CSV on the instrument"},
    {0, ":WFM#"sv, "a binary Tektronix waveform (wfm)", "save the waveform as CSV on the instrument"},
    {0, "RIFF"sv, "a sound (WAV)", "export it as CSV with its times"},
    {0, "TDMm"sv, "a DIAdem header (tdm)", "export the channels as TDMS or CSV"},
    {0, "<?xml version=\"1.0\" encoding=\"UTF-8\" ?><usi:tdm"sv, "a DIAdem header (tdm)",
     "export the channels as TDMS or CSV"},
};

struct Ending {
  const char* ending;
  const char* what;
  const char* cure;
};
constexpr Ending endings[] = {
    {".slx", "a Simulink model", "name a recording of its signals: log them, and save a MAT file with save(...)"},
    {".mdl", "a Simulink model", "name a recording of its signals: log them, and save a MAT file with save(...)"},
    {".m", "a MATLAB program", "run it there, and save its columns: writetable(table(t, u, y), \"lab.csv\")"},
    {".mlx", "a MATLAB live script", "run it there, and save its columns: writetable(table(t, u, y), \"lab.csv\")"},
    {".fig", "a MATLAB figure", "save the numbers that it shows: writetable(table(t, u, y), \"lab.csv\")"},
    {".ods", "an OpenDocument spreadsheet (ods)", "save it as xlsx, or as CSV UTF-8"},
    {".odt", "a text document", "name the file that holds the numbers"},
    {".docx", "a Word document", "name the file that holds the numbers"},
    {".xlsb", "a binary Excel workbook (xlsb)", "save it as xlsx, or as CSV UTF-8"},
    {".npz", "an archive of NumPy arrays", "write them as CSV (numpy.savetxt)"},
    {".ipynb", "a notebook", "name the file that it reads its numbers from"},
    {".psdata", "a PicoScope document", "save it as CSV or MAT from PicoScope"},
    {".sal", "a Saleae capture", "export the analog channels as CSV from Logic"},
    {".dwf3work", "a WaveForms workspace", "export the scope as CSV from WaveForms"},
    {".zip", "a zip archive", "unpack it and name what is in it"},
};

}  // namespace

KnownFile known_file(std::string_view bytes, const std::string& file) {
  const std::string ending = lower_case_of(std::filesystem::path(file).extension().string());
  const bool is_zip = bytes.starts_with("PK\x03\x04");
  const bool is_text = bytes.find('\0') == bytes.npos;
  for (const auto& e : endings)
    if (ending == e.ending && (is_zip || !is_text || ending == ".m" || ending == ".mdl" || ending == ".ipynb"))
      return {e.what, e.cure};
  if (is_zip) return {"a zip archive", "unpack it and name what is in it"};
  for (const auto& s : signatures)
    if (bytes.substr(std::min(s.at, bytes.size())).starts_with(s.bytes)) {
      if (s.bytes == "BM"sv && is_text) continue;  // two letters begin many a text
      if (s.bytes == "#9"sv && is_text) continue;
      return {s.what, s.cure};
    }
  const auto first = bytes.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  if (first == bytes.npos) return {};
  const std::string begin = lower_case_of(bytes.substr(first, 64));
  if (begin.starts_with("<!doctype html") || begin.starts_with("<html"))
    return {"a page of the web (HTML)", "download the file itself: this may be the page of a login"};
  if (begin.starts_with("<?xml")) return {"an XML document", export_cure};
  if (begin.starts_with("{\"cells\"") || begin.starts_with("{\n \"cells\""))
    return {"a notebook", "name the file that it reads its numbers from"};
  if (begin.starts_with("model {")) return {"a Simulink model", endings[0].cure};
  if (begin.starts_with("version https://git-lfs"))
    return {"the pointer of Git LFS to a file that is not here", "fetch it: git lfs pull"};
  return {};
}

}  // namespace hysteron
