#include "blocks/sources/time_table.h"

#include <fmt/format.h>

namespace hysteron::blocks {

void TimeTable::describe(Declaration& d) {
  d.name("time_table", "signal from a table of points over time").in_group("sources");
  d.law(
       "linear: straight lines from point to point; hold: each value is held until the next; akima: a "
       "smooth curve through the points; outside the table constant, or repeated periodically")
      .from("Akima, J. ACM 17 (1970) 589-602");
  d.remark(
      "From a file: \"parameters\": \"points.csv\", with the columns times and values and their units in "
      "the headers (\"times [ms]\"). For a signal that was measured together with the data of a fit use "
      "\"recorded\", or an input of the diagram.");
  d.remark("With linear and hold the values can be fitted by linear least squares, with akima they cannot.");
  d.remark(
      "With \"repeat\": \"yes\" the table starts again with its first point at the time of its last point; "
      "if the two values differ, the signal jumps there.");
  d.remark(
      "With \"hold\" the output jumps: a block that is driven by the rate of its input (e.g. bouc_wen) "
      "needs a lag in between.");
  d.output("y", "$a", "the signal");
  d.list("times", "s", "times of the points").increasing();
  d.list("values", "$a", "values at these times").as_long_as("times");
  d.text("between_points", {"linear", "hold", "akima"}, "interpolation between the points");
  d.text("repeat", {"no", "yes"}, "whether the table repeats periodically after its last point");
}

/// Akima's curve is not affine in its values.
Declaration TimeTable::instance(const Declaration& type, const Node& block) {
  Declaration d = type;
  if (written_text(block, "between_points").value_or("linear") != "akima") d.parameters[values].linear();
  return d;
}

Sizes TimeTable::sizes(const Shape& shape) {
  Sizes s;
  s.feedthrough = false;
  if (shape.text("between_points") == "hold" || shape.text("repeat") == "yes") s.smoothness = Smoothness::jumps;
  const int n = shape.length("times");
  if (n != shape.length("values"))
    s.error = fmt::format("{} \"times\" and {} \"values\"; give one of each per point", n, shape.length("values"));
  else if (n < 2)
    s.error = "a table needs at least two points; for one point use a \"constant\"";
  return s;
}

double TimeTable::next_breakpoint(const View<double>& v) {
  const auto at = v.list(times);
  const Place p = place(v, v.t);
  const auto next = static_cast<std::size_t>(p.piece + 1);
  if (next == at.size()) return signals::never;
  return signals::strictly_behind(v.t, at[next] + p.round * (at.back() - at.front()));
}

Kernel time_table_block() {
  Kernel k = kernel<TimeTable>();
  k.instance = &TimeTable::instance;
  return k;
}

}  // namespace hysteron::blocks
