// Decides how a job with "do": "runs" looks in the JSON Schema. Internal to io.
#pragma once

#include "io/schema_parts.h"

namespace hysteron::schema {

/// An object with the members of such a job.
Json runs_job();

}  // namespace hysteron::schema
