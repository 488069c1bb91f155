// Decides how an answer looks to programs: the one object that --json prints, and the schema of it.
// Does not decide what a verb has to say (Answer::facts) nor what that means (Verb::shape).
#pragma once

#include <string>
#include <vector>

#include "app/cli/answer.h"

namespace hysteron {

/// `notes`: what was said while the verb worked.
std::string answer_json(const Verb& verb, const Answer& answer, const std::vector<std::string>& notes);

/// The JSON Schema of what answer_json() gives for this verb.
std::string answer_schema(const Verb& verb);

/// The file of that schema: "run.answer.schema.json".
std::string answer_schema_name(const Verb& verb);

/// A file with this JSON Schema (shape.h).
std::string schema_text(const std::string& title, const Facts& shape);

}  // namespace hysteron
