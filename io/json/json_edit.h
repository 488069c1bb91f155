// Decides how one value of a JSON text is changed so that all else stays byte for byte as it was: what an editor does,
// where a writer would lay the whole file out anew. Does not know what the values mean.
#pragma once

#include <string>
#include <vector>

namespace hysteron {

struct JsonEdit {
  enum class Kind {
    replace,  ///< the value at `pointer` becomes `value`
    insert,   ///< the object at `pointer` gets a member `key`, the list an element at its end
    remove,   ///< the member or element at `pointer` goes, with its comma
    rename    ///< the member at `pointer` gets the name `key`
  };
  Kind kind = Kind::replace;
  std::string pointer;  ///< RFC 6901; "" = the whole text
  std::string key{};    ///< as it is read, without quotes
  std::string value{};  ///< JSON
  std::string after{};  ///< insert: behind the member of this name, where there is one; else at the end
};

/// The text after all edits, each applied to what the ones before left. A new member stands on a line of its own where
/// its neighbours do, indented and aligned like these. Throws Error "bad_json" (of the text or a value), "no_place" (a
/// pointer that leads nowhere, or to a value of another kind), "key_there" (a name that the object has already).
std::string edited_json(const std::string& text, const std::vector<JsonEdit>& edits);

}  // namespace hysteron
