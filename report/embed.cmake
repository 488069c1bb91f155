# Turns the style and the script of the report into C++ strings, with the hashes that its content security policy names.
# cmake -DCSS=report.css -DJS=report.js -DOUTPUT=assets.cpp -P embed.cmake
file(READ ${CSS} css)
file(READ ${JS} js)
file(SHA256 ${CSS} css_hash)
file(SHA256 ${JS} js_hash)
file(WRITE ${OUTPUT} "// Made by report/embed.cmake from report/assets; do not edit.
#include \"report/page/assets.h\"

namespace hysteron {
const std::string_view report_css = R\"_asset_(${css})_asset_\";
const std::string_view report_css_sha256 = \"${css_hash}\";
const std::string_view report_js = R\"_asset_(${js})_asset_\";
const std::string_view report_js_sha256 = \"${js_hash}\";
}  // namespace hysteron
")
