// Decides nothing: the style and the script of the report, embedded at build time from report/assets.
#pragma once

#include <string_view>

namespace hysteron {

extern const std::string_view report_css, report_css_sha256;  ///< text, and its hash in hexadecimal digits
extern const std::string_view report_js, report_js_sha256;

}  // namespace hysteron
