// Decides how a job with "do": "study" looks in the JSON Schema. Internal to io.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace hysteron::schema {

nlohmann::ordered_json study_job();

}  // namespace hysteron::schema
