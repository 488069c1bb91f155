#include "blocks/sources/time_table.h"

#include <fmt/format.h>

namespace hysteron::blocks {

void TimeTable::describe(Declaration& d) {
  d.name("time_table", "points over time, from the diagram or a file").in_group("sources");
  d.law(
       "linear: straight lines from point to point; hold: each until the next; akima: a smooth curve through them; "
       "constant outside, or from the first point again")
      .from("Akima, J. ACM 17 (1970) 589-602");
  d.remark(
      "From a file: \"parameters\": \"way.csv\", with the columns times and values, units in their headers (\"times "
      "[ms]\"). What was measured along with the data of a fit is \"recorded\", or an input of the diagram.");
  d.remark("The values of all but a smooth curve (akima) can be fitted, by linear least squares.");
  d.remark(
      "\"repeat\": \"yes\" begins again with the first point where the last one is; where these two differ it jumps "
      "there.");
  d.remark("A held table jumps: a law that is driven by the rate of its input (bouc_wen) needs a lag in between.");
  d.output("y", "$a", "the signal");
  d.list("times", "s", "instants of the points").increasing();
  d.list("values", "$a", "values there").as_long_as("times");
  d.text("between_points", {"linear", "hold", "akima"}, "how it moves from point to point");
  d.text("repeat", {"no", "yes"}, "whether it begins again behind the last point");
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
    s.error = "a table of one point does not move; give two points or more, or a \"constant\"";
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
