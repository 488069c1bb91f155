// Decides how text of any origin becomes safe in HTML, SVG and embedded JSON. Knows nothing of documents.
#pragma once

#include <string>
#include <string_view>

namespace hysteron {

/// Text as content or attribute value: & < > " ' become entities; control characters that HTML does not allow vanish.
std::string escape(std::string_view text);

/// As escape, and `code` between backticks is set as code: names of blocks and effects in a sentence.
/// A number stays on one line with its unit.
std::string escape_prose(std::string_view text);

/// JSON text for a <script type="application/json">: no "<" that could end the element. `json` must be valid JSON.
std::string escape_json(std::string_view json);

}  // namespace hysteron
