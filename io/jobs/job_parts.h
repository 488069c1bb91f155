// Decides how the pieces stand in JSON that several kinds of jobs share: texts and numbers with their places, windows,
// lists of names. Internal to io.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/jobs/job_file.h"
#include "io/jobs/runs_job.h"
#include "io/json/json_reader.h"

namespace hysteron::job_parts {

WrittenText text_at(const JsonPlace& place);
std::optional<WrittenText> text_of(const JsonPlace& object, const char* key);
std::optional<WrittenNumber> number_of(const JsonPlace& object, const char* key);
bool truth_of(const JsonPlace& object, const char* key);
/// A text, or a list of texts.
std::vector<WrittenText> texts_of(const JsonPlace& object, const char* key);
/// ["0.8 s", "1 s"]
Window window_of(const JsonPlace& object, const char* key = "between");
/// A whole number from `least` to `most`; notes "bad_value".
std::optional<double> whole_at(const JsonPlace& place, double least, double most);
/// One of the known texts; notes "bad_value" with the nearest.
std::optional<std::string> one_of(const JsonPlace& object, const char* key, const std::vector<std::string>& known);
/// {"controller.kp": "0.5 V/um"}, {"compensator": "none"}.
std::vector<Override> settings_of(const JsonPlace& object, const char* key);

}  // namespace hysteron::job_parts
