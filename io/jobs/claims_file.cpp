#include "io/jobs/claims_file.h"

#include "io/json/json_reader.h"
#include "io/json/schema_parts.h"

namespace hysteron {

std::vector<PublishedClaim> read_claims(const std::string& file) {
  JsonFile json(file);
  const JsonPlace root = json.root();
  std::vector<PublishedClaim> list;
  if (root.expect_object("{\"format\": 1, \"claims\": {\"C2-07\": {\"says\": \"...\"}}}")) {
    check_format(root, "file of claims");
    root.only({"$schema", "format", "title", "source", "remark", "claims"});
    const auto claims = root.need("claims", "write \"claims\": {\"C2-07\": {\"says\": \"...\"}}");
    if (claims && claims->expect_object("{\"C2-07\": {\"says\": \"...\"}}"))
      for (const auto& [id, place] : claims->members()) {
        if (!place.expect_object("{\"says\": \"...\"}")) continue;
        place.only({"says", "from", "calibrated", "cannot", "remark"});
        PublishedClaim claim;
        claim.id = id;
        if (const auto says = place.need("says", "write what the claim says")) claim.says = says->text().value_or("");
        claim.from = text_member(place, "from");
        claim.calibrated = text_member(place, "calibrated");
        claim.cannot = text_member(place, "cannot");
        claim.remark = text_member(place, "remark");
        list.push_back(std::move(claim));
      }
  }
  json.throw_if_any();
  return list;
}

std::string claims_schema() {
  using namespace schema;
  const char* about = "Claims of a published work, each said once; jobs with \"do\": \"runs\" settle them.";
  Json properties;
  add_head_members(properties);
  Json claim =
      object("one claim",
             {{"says", text("what it says, in a sentence")},
              {"from", text("where the expected numbers come from: thesis, oracle")},
              {"calibrated", text("what was tuned to reach it: agreement then proves only that it is reachable")},
              {"cannot", text("why it cannot be checked")},
              {"remark", text("what a reader should know")}},
             {"says"});
  properties["claims"] = {{"type", "object"}, {"description", "by id"}, {"additionalProperties", std::move(claim)}};
  Json json = head("hysteron claims", about);
  json.update(object(about, std::move(properties), {"format", "claims"}));
  return to_text(json);
}

}  // namespace hysteron
