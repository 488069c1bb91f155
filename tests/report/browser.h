// Decides how a page is opened in a real browser in tests: headless Chromium, own profile, nothing in the background.
#pragma once

#include <string>

namespace hysteron::browser {

/// Path of a Chromium on this machine, or "": then tests that need one are skipped, visibly.
std::string find();

/// The page as it stands after its scripts have run. `file` must be an absolute path.
std::string dump_dom(const std::string& file);

}  // namespace hysteron::browser
