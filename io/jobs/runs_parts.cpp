#include "io/jobs/runs_parts.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/jobs/job_parts.h"
#include "io/json/value_text.h"

namespace hysteron::job_parts {
namespace {

/// A number with its unit as text, or a plain number.
std::optional<WrittenText> quantity_of(const JsonPlace& object, const char* key) {
  const auto place = object.find(key);
  if (place && place->is_number()) return WrittenText{exact_number_text(*place->number()), place->pointer()};
  return text_of(object, key);
}

/// "points": [["0.1 s", "2 um"], ["0.2 s", "3 um"]]
void points(const JsonPlace& object, ValueWish& v) {
  constexpr char example[] = "[[\"0.1 s\", \"2 um\"], [\"0.2 s\", \"3 um\"]]";
  const auto place = object.need("points", fmt::format("say where the curve has to pass: \"points\": {}", example));
  if (!place || !place->expect_array(example)) return;
  for (const auto& point : place->elements()) {
    if (!point.expect_array("[\"0.1 s\", \"2 um\"]")) continue;
    const auto ends = point.elements();
    if (ends.size() != 2) {
      point.add("bad_value", "a point is a place and the value there", "write [\"0.1 s\", \"2 um\"]");
      continue;
    }
    const auto x = read_number(ends[0]), y = read_number(ends[1]);
    if (x && y) v.points.push_back({{*x, ends[0].pointer()}, {*y, ends[1].pointer()}});
  }
  if (v.points.empty()) place->add("bad_value", "there is no point", fmt::format("write {}", example));
}

AxisWish axis(const JsonPlace& place) {
  AxisWish a;
  const auto signal = [&](const JsonPlace& object) {
    SignalWish wish;
    if (const auto at = object.find("signal")) wish.signal = text_at(*at);
    read_minus(object, wish);
    return wish;
  };
  if (!place.expect_object("{\"signal\": \"stage\", \"unit\": \"um\"}")) return a;
  place.only({"signal", "signals", "minus", "label", "unit", "from", "to", "log"});
  for (const auto& one : texts_of(place, "signals")) a.signals.push_back({one});
  if (place.find("signal")) a.signals.push_back(signal(place));
  a.label = text_member(place, "label");
  a.unit = text_of(place, "unit");
  a.from = number_of(place, "from");
  a.to = number_of(place, "to");
  a.log = truth_of(place, "log");
  return a;
}

}  // namespace

void read_minus(const JsonPlace& object, SignalWish& wish) {
  const auto place = object.find("minus");
  if (!place) return;
  if (place->is_object()) {
    place->only({"run", "signal"});
    if (const auto run = place->need("run", "name the run that is subtracted")) wish.minus_run = text_at(*run);
    if (const auto signal = place->need("signal", "name the signal that is subtracted")) wish.minus = text_at(*signal);
  } else {
    wish.minus = text_at(*place);
  }
}

std::vector<RowCondition> conditions_of(const JsonPlace& object) {
  std::vector<RowCondition> list;
  const auto place = object.find("where");
  if (!place || !place->expect_array("[{\"signal\": \"gamma\", \"from\": 0.15, \"to\": 0.25}]")) return list;
  for (const auto& one : place->elements()) {
    if (!one.expect_object("{\"signal\": \"gamma\", \"from\": 0.15, \"to\": 0.25}")) continue;
    one.only({"signal", "minus", "from", "to"});
    RowCondition c;
    if (const auto signal = one.need("signal", "name the signal that decides")) c.signal.signal = text_at(*signal);
    read_minus(one, c.signal);
    c.from = number_of(one, "from");
    c.to = number_of(one, "to");
    if (!c.from && !c.to) one.add("missing_key", "nothing says which rows are meant", "write \"from\", \"to\" or both");
    list.push_back(std::move(c));
  }
  return list;
}

ValueWish value_of(const std::string& name, const JsonPlace& place, bool needs_run) {
  ValueWish v;
  v.name = name;
  v.pointer = place.pointer();
  if (!place.expect_object("{\"take\": \"stroke\", \"of\": \"stage\", \"run\": \"none\"}")) return v;
  for (const auto& combination : combinations())
    if (const auto at = place.find(combination)) {
      place.only({combination, "remark"});
      v.take = {combination, at->pointer()};
      v.over_values = texts_of(place, combination.c_str());
      if ((combination == "ratio" || combination == "difference") && v.over_values.size() != 2)
        at->add("bad_value", fmt::format("a {} is of two values", combination), "write [\"first\", \"second\"]");
      return v;
    }
  if (place.find("constant")) {
    place.only({"constant", "remark"});
    v.constant = number_of(place, "constant");
    v.take = {"constant", place.pointer()};
    return v;
  }
  place.only({"take", "of", "minus", "same_stroke", "over", "run", "between", "rezero", "where", "at", "above", "below",
              "figure", "parameter", "points", "remark"});
  text_member(place, "remark");
  const auto take = place.need("take", "say what is taken: \"stroke\", \"rms\", \"area\" ...");
  if (take) v.take = text_at(*take);
  if (take && std::find(takes().begin(), takes().end(), v.take.text) == takes().end())
    take->add("bad_value", fmt::format("{} cannot be taken", json_quoted(v.take.text)),
              did_you_mean(v.take.text, takes()));
  v.of.signal = text_of(place, "of").value_or(WrittenText{"", place.pointer()});
  read_minus(place, v.of);
  v.of.same_stroke = truth_of(place, "same_stroke");
  if (v.of.same_stroke && !v.of.minus)
    place.add("missing_key", "nothing says whose stroke it is scaled to",
              "write \"minus\": {\"run\": \"actuator\", \"signal\": \"y\"}");
  v.over = text_of(place, "over");
  if (v.take.text == "area" && !v.over)
    place.add("missing_key", "an area is of one signal over another", "write \"over\": \"drive\"");
  if (v.take.text == "at") place.need("at", "say when: \"at\": \"0.2 s\"");
  if (v.take.text == "off_points") points(place, v);
  v.between = window_of(place);
  v.rezero = truth_of(place, "rezero");
  v.where = conditions_of(place);
  v.at = number_of(place, "at");
  v.above = number_of(place, "above");
  v.below = number_of(place, "below");
  if (v.take.text == "share" && !v.above && !v.below)
    place.add("missing_key", "nothing says which rows are counted", "write \"above\" or \"below\"");
  v.figure = text_of(place, "figure").value_or(text_of(place, "parameter").value_or(WrittenText{"", place.pointer()}));
  if (needs_run && v.take.text != "computed") place.need("run", "name the run on which it is taken");
  v.run = text_of(place, "run").value_or(WrittenText{"", place.pointer()});
  return v;
}

std::optional<PlotWish> plot_of(const JsonPlace& place) {
  if (!place.expect_object("{\"title\": \"...\", \"y\": {\"signal\": \"stage\"}}")) return {};
  place.only({"title", "kind", "x", "y", "runs", "between", "rezero", "where", "bins", "caption", "remark"});
  PlotWish p;
  p.pointer = place.pointer();
  p.title = text_member(place, "title");
  p.caption = text_member(place, "caption");
  static const std::vector<std::string> kinds{"curve", "spectrum", "histogram", "scatter", "medians", "bode"};
  if (const auto kind = text_of(place, "kind")) {
    p.kind = kind->text;
    if (std::find(kinds.begin(), kinds.end(), p.kind) == kinds.end())
      place.find("kind")->add("bad_value", fmt::format("{} is no kind of plot", json_quoted(p.kind)),
                              did_you_mean(p.kind, kinds));
  }
  if (const auto x = place.find("x")) p.x = axis(*x);
  if (const auto y = p.kind == "bode" ? place.find("y") : place.need("y", "say what is drawn: {\"signal\": \"stage\"}"))
    p.y = axis(*y);
  if (p.kind != "bode" && p.y.signals.empty() && place.find("y"))
    place.find("y")->add("missing_key", "nothing says which signal is drawn", "write \"signal\": \"stage\"");
  p.runs = texts_of(place, "runs");
  p.between = window_of(place);
  p.rezero = truth_of(place, "rezero");
  p.where = conditions_of(place);
  if (p.kind == "medians" && p.x.signals.empty())
    place.add("missing_key", "medians are of y over x", "write \"x\": {\"signal\": \"iteration\"}");
  if (const auto bins = number_member(place, "bins")) p.bins = std::clamp(static_cast<int>(*bins), 2, 1000);
  return p;
}

std::optional<ClaimPart> claim_of(const JsonPlace& place) {
  if (!place.expect_object(
          "{\"id\": \"C2-07\", \"value\": \"stroke\", \"expected\": \"6.6 um\", \"tolerance\": \"1 %\"}"))
    return {};
  place.only({"id", "value", "expected", "tolerance", "thesis", "must", "order", "above", "below", "remark"});
  ClaimPart c;
  c.pointer = place.pointer();
  if (const auto id = place.need("id", "write \"id\": \"C2-07\"")) c.id = id->text().value_or("");
  c.value = text_of(place, "value").value_or(WrittenText{"", place.pointer()});
  c.expected = quantity_of(place, "expected");
  c.tolerance = quantity_of(place, "tolerance");
  c.above = quantity_of(place, "above");
  c.below = quantity_of(place, "below");
  c.thesis = text_member(place, "thesis");
  c.remark = text_member(place, "remark");
  c.order = texts_of(place, "order");
  if (const auto must = text_of(place, "must")) {
    c.must_differ = must->text == "differ";
    if (must->text != "differ" && must->text != "agree")
      place.find("must")->add("bad_value", fmt::format("\"must\" cannot be {}", json_quoted(must->text)),
                              "write \"must\": \"differ\", or leave it out");
  }
  if (c.order.empty() && c.value.text.empty())
    place.add("missing_key", "nothing says which value the claim is about",
              "write \"value\": \"stroke\", or \"order\"");
  if (c.order.empty() && !c.expected && !c.above && !c.below)
    place.add("missing_key", "nothing says what the claim expects", "write \"expected\", \"above\" or \"below\"");
  if (c.expected && !c.tolerance)
    place.add("missing_key", "an expected value needs a tolerance", "write \"tolerance\": \"1 %\" or \"1e-6 um\"");
  return c;
}

}  // namespace hysteron::job_parts
