#include "io/jobs/job_parts.h"

#include <fmt/format.h>

#include <cmath>

#include "io/json/value_text.h"

namespace hysteron::job_parts {

WrittenText text_at(const JsonPlace& place) { return {place.text().value_or(""), place.pointer()}; }

std::optional<WrittenText> text_of(const JsonPlace& object, const char* key) {
  const auto place = object.find(key);
  return place ? std::optional(text_at(*place)) : std::nullopt;
}

std::optional<WrittenNumber> number_of(const JsonPlace& object, const char* key) {
  const auto place = object.find(key);
  const auto read = place ? read_number(*place) : std::nullopt;
  return read ? std::optional(WrittenNumber{*read, place->pointer()}) : std::nullopt;
}

bool truth_of(const JsonPlace& object, const char* key) {
  const auto place = object.find(key);
  return place && place->truth().value_or(false);
}

std::vector<WrittenText> texts_of(const JsonPlace& object, const char* key) {
  std::vector<WrittenText> list;
  const auto place = object.find(key);
  if (!place) return list;
  if (place->is_text()) return {text_at(*place)};
  if (place->expect_array("[\"one\", \"two\"]"))
    for (const auto& element : place->elements()) list.push_back(text_at(element));
  return list;
}

Window window_of(const JsonPlace& object, const char* key) {
  Window w;
  const auto place = object.find(key);
  if (!place || !place->expect_array("[\"0.8 s\", \"1 s\"]")) return w;
  const auto ends = place->elements();
  if (ends.size() != 2) {
    place->add("bad_value", "a window has two ends", "write \"between\": [\"0.8 s\", \"1 s\"]");
    return w;
  }
  const auto from = read_number(ends[0]), to = read_number(ends[1]);
  if (from && to) {
    w.from = WrittenNumber{*from, ends[0].pointer()};
    w.to = WrittenNumber{*to, ends[1].pointer()};
  }
  return w;
}

std::optional<double> whole_at(const JsonPlace& place, double least, double most) {
  const auto value = place.number();
  if (!value) return {};
  if (*value == std::floor(*value) && *value >= least && *value <= most) return value;
  place.add("bad_value", fmt::format("{} is no whole number from {} to {}", *value, least, most),
            fmt::format("write a whole number from {} to {}", least, most));
  return {};
}

std::optional<std::string> one_of(const JsonPlace& object, const char* key, const std::vector<std::string>& known) {
  const auto place = object.find(key);
  const auto text = place ? place->text() : std::nullopt;
  if (!text) return {};
  for (const auto& k : known)
    if (k == *text) return text;
  place->add("bad_value", fmt::format("{} is not known here", json_quoted(*text)), did_you_mean(*text, known));
  return {};
}

std::vector<Override> settings_of(const JsonPlace& object, const char* key) {
  std::vector<Override> list;
  const auto place = object.find(key);
  if (!place || !place->expect_object("{\"controller.kp\": \"0.5 V/um\"}")) return list;
  for (const auto& [name, value] : place->members()) {
    if (value.is_number())
      list.push_back({name, exact_number_text(*value.number())});
    else if (const auto text = value.text())
      list.push_back({name, *text});
  }
  return list;
}

}  // namespace hysteron::job_parts
