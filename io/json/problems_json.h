// Decides how problems stand in JSON for programs. Does not print them.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "engine/diagram/error.h"

namespace hysteron {

/// [{"code", "path", "what", "cure", "file", "line"}]; file and line where they are known.
nlohmann::ordered_json problem_list(const std::vector<Problem>& problems);

/// {"exit_code": 2, "problems": [...]}; what is no UTF-8 is replaced.
std::string problems_json(const std::vector<Problem>& problems, int code);

}  // namespace hysteron
