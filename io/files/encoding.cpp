#include "io/files/encoding.h"

#include "engine/diagram/error.h"

namespace hysteron {

void refuse_utf16(const std::string& file, std::string_view text) {
  // Its byte order mark, or the other half of a first letter of the Latin alphabet.
  const bool marked = text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF");
  const bool halved = text.size() > 1 && (text[0] == '\0') != (text[1] == '\0');
  if (marked || halved)
    throw Error(Fault::input, {{"not_utf8", file, "the file is written in UTF-16, UTF-8 was expected",
                                "save it as UTF-8 (spreadsheets call it \"CSV UTF-8\")", file, 1}});
}

}  // namespace hysteron
