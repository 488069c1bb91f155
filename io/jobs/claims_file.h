// Decides how the claims of a published work stand in a file (diagrams/claims.json): what each says, once, for all jobs
// that settle parts of it. Does not decide whether a claim holds (app/jobs/claims.h).
#pragma once

#include <string>
#include <vector>

namespace hysteron {

struct PublishedClaim {
  std::string id, says;
  std::string from;        ///< where the expected numbers come from: "thesis", "oracle"
  std::string calibrated;  ///< "" or what was tuned to reach it
  std::string cannot;      ///< "" or why it cannot be checked
  std::string remark;
};

/// In the order of the file. Throws Error naming file, line and key.
std::vector<PublishedClaim> read_claims(const std::string& file);

/// JSON Schema of a file of claims.
std::string claims_schema();

}  // namespace hysteron
