// Decides how a job with "do": "runs" looks in the JSON Schema. Internal to io.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace hysteron::schema {

nlohmann::ordered_json runs_job();

}  // namespace hysteron::schema
