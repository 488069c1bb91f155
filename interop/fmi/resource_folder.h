// Decides where the folder with the resources of an FMU lies, however the caller says it.
#pragma once

#include <string>

namespace hysteron::interop {

/// "file:///tmp/x%20y/resources", "file:/tmp/...", "/tmp/x y/resources/"; "": beside the binary that this code is in.
std::string resource_folder(const std::string& given);

}  // namespace hysteron::interop
