// Decides with which command a job file is run, for those who gave it to another verb. Does not read it.
#pragma once

#include <string>

namespace hysteron {

/// "hysteron study tolerance.json": `what` is "fit", "study" or "runs", as the job says under "do". Works as printed in
/// the folder from which `file` is seen.
std::string job_command(const std::string& what, const std::string& file);

}  // namespace hysteron
