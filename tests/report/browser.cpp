#include "browser.h"

#include <stdlib.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

namespace hysteron::browser {
namespace {

/// What a shell command prints on stdout.
std::string output_of(const std::string& command) {
  std::string text;
  FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) throw std::runtime_error("no shell");
  std::array<char, 65536> buffer{};
  while (const auto n = std::fread(buffer.data(), 1, buffer.size(), pipe)) text.append(buffer.data(), n);
  pclose(pipe);
  return text;
}

}  // namespace

std::string find() {
  std::string path =
      output_of("command -v chromium || command -v chromium-browser || command -v google-chrome || true");
  return path.substr(0, path.find('\n'));
}

std::string dump_dom(const std::string& file) {
  std::string profile = (std::filesystem::temp_directory_path() / "hysteron_browser_XXXXXX").string();
  if (!mkdtemp(profile.data())) throw std::runtime_error("no temporary folder");
  const std::string dom =
      output_of("timeout 120 " + find() +
                " --headless --no-sandbox --disable-gpu --disable-quic --no-first-run --disable-background-networking"
                " --disable-component-update --disable-sync --disable-dev-shm-usage --window-size=1200,1000 "
                "--virtual-time-budget=5000"
                " --user-data-dir='" +
                profile + "' --dump-dom 'file://" + file + "' 2>/dev/null");
  std::error_code ignored;
  std::filesystem::remove_all(profile, ignored);
  return dom;
}

}  // namespace hysteron::browser
