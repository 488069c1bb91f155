// Decides where the page comes from: files that the build put into the program (page/, CMakeLists.txt).
#pragma once

#include <string_view>
#include <vector>

namespace hysteron::studio {

struct PageFile {
  std::string_view path;  ///< "/index.html"
  std::string_view type;  ///< "text/html"
  std::string_view content;
};

/// Empty where the program was built without the page.
const std::vector<PageFile>& page_files();

}  // namespace hysteron::studio
