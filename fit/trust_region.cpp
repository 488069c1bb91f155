#include "fit/trust_region.h"

#include <dlfcn.h>

#include <filesystem>
#include <system_error>

#include "engine/error.h"

namespace hysteron {
namespace {

using Minimize = void (*)(const LeastSquares*, const std::vector<double>*, int, double, TrustRegionResult*);

/// The module lies where it was built, or, installed, in lib/hysteron beside the folder of the program.
Minimize load() {
  std::error_code code;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", code);
  std::string reason;
  for (const auto& folder :
       {program.parent_path().parent_path() / "lib" / "hysteron", std::filesystem::path(HYSTERON_MODULE_FOLDER)}) {
    void* module = dlopen((folder / HYSTERON_TRUST_REGION).c_str(), RTLD_NOW | RTLD_LOCAL);
    if (module != nullptr) return reinterpret_cast<Minimize>(dlsym(module, "hysteron_minimize"));
    reason += (reason.empty() ? "" : "; ") + std::string(dlerror());
  }
  fail("no_solver", HYSTERON_TRUST_REGION, "the least-squares solver cannot be loaded: " + reason,
       "build or install hysteron again, and keep lib/hysteron beside bin/");
}

}  // namespace

TrustRegionResult minimize(const LeastSquares& problem, std::vector<double> start, int max_iterations,
                           double tolerance) {
  static const Minimize solve = load();
  TrustRegionResult result;
  solve(&problem, &start, max_iterations, tolerance, &result);
  return result;
}

}  // namespace hysteron
