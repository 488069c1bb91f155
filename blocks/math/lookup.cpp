#include "blocks/math/lookup.h"

#include <fmt/format.h>

#include <algorithm>

namespace hysteron::blocks {
namespace {

const std::array axis_names{"at", "at_2", "at_3", "at_4"};

}  // namespace

void Lookup::describe(Declaration& d) {
  d.name("lookup", "lookup table over one to four axes, with interpolation").in_group("math");
  d.elementwise().at("core");
  d.law("y = values at the knots \"at\"; between them linear, or a smooth curve through them")
      .from(
          "linear: definition; akima: J. ACM 17 (1970) 589-602; monotone: Fritsch, Butland, SIAM J. Sci. Stat. Comput. 5 "
          "(1984) 300-304; several axes: one after the other");
  d.remark(
      "With two axes \"values\" is a list of rows: one row per knot of \"at\", one number per knot of "
      "\"at_2\". With three or four axes it is a flat list, the last axis varying fastest. Each wire "
      "belongs to one axis: \"in\": [\"current\", \"position\"].");
  d.remark(
      "From a file: \"parameters\": \"curve.csv\", with the columns at and values, units in their headers (\"at [mm]\").");
  d.remark(
      "A linear table has kinks at its knots, which are located. Its values can be fitted by linear least "
      "squares. Of the smooth curves, akima overshoots little and monotone not at all.");
  d.remark(
      "With \"outside\": \"refuse\" the run ends beyond the knots; give further knots, or \"outside\": \"clip\" or "
      "\"extrapolate\".");
  d.inputs_any("in", "$a", "one signal per axis");
  d.output("y", "$y", "the interpolated value");
  d.list("values", "$y", "values at the knots").or_matrix().difference();
  d.list("at", "$a", "knots of the first axis, two at least").increasing();
  d.list("at_2", "$b", "knots of the second axis").optional("").increasing();
  d.list("at_3", "$c", "knots of the third axis").optional("").increasing();
  d.list("at_4", "$d", "knots of the fourth axis").optional("").increasing();
  d.text("between", {"linear", "akima", "monotone"},
         "interpolation: linear; akima (smooth); monotone (smooth, without overshoot)");
  d.text("outside", {"clip", "extrapolate", "refuse"},
         "outside the knots: clip holds the end value, extrapolate continues linearly, refuse stops the run");
}

/// The value is affine in the values of a straight table only.
Declaration Lookup::instance(const Declaration& type, const Node& block) {
  Declaration d = type;
  if (written_text(block, "between").value_or("linear") == "linear") d.parameters[values].linear();
  return d;
}

Sizes Lookup::sizes(const Shape& shape) {
  Sizes s;
  int axes = 0, all = 1;
  for (const char* name : axis_names)
    if (const int n = shape.length(name); n > 0) {
      if (name != axis_names[static_cast<std::size_t>(axes)])
        s.error = fmt::format("\"{}\" is given, \"{}\" is not", name, axis_names[static_cast<std::size_t>(axes)]);
      if (n < 2) s.error = fmt::format("\"{}\" has one knot; give two at least", name);
      ++axes;
      all *= n;
    }
  if (axes != shape.inputs)
    s.error = fmt::format("{} wires for {} axes; give each wire its knots: \"{}\"", shape.inputs, axes,
                          axis_names[static_cast<std::size_t>(std::clamp(shape.inputs, 1, lookup::most_axes)) - 1]);
  const int columns = shape.columns_of("values");
  if (s.error.empty() &&
      (shape.length("values") != all || (columns > 0 && axes > 0 && columns * shape.length("at") != all)))
    s.error = columns > 0 ? fmt::format("\"values\" has {} rows of {}, the axes make {} of {}", shape.rows_of("values"),
                                        columns, shape.length("at"), all / shape.length("at"))
                          : fmt::format("\"values\" has {} numbers, the axes make {}", shape.length("values"), all);
  s.input_units = {"$a", "$b", "$c", "$d"};
  s.kinks = shape.text("between") == "linear" || shape.text("outside") == "clip" ? shape.inputs : 0;
  return s;
}

void Lookup::kinks(const View<double>& v) {
  std::array<lookup::Axis<double>, lookup::most_axes> all;
  const bool clips = v.choice(outside) == static_cast<int>(lookup::Outside::clip);
  int i = 0;
  for (const auto& axis : axes_of(v, all)) {
    const double lower = axis.u - axis.knots.front(), upper = axis.knots.back() - axis.u;
    v.out[i++] =
        v.choice(between) == static_cast<int>(lookup::Between::linear) ? lookup::knot_kink(axis, clips) : lower * upper;
  }
}

/// The table is looked up once per lane, not once per row.
void Lookup::rows(const RowsView& r) {
  for (int lane = 0; lane < r.lanes; ++lane) {
    const View<double>& v = r.views[lane];
    std::array<lookup::Axis<double>, lookup::most_axes> all;
    const auto axes = knots_of(v, all);
    const auto values_there = v.list(values);
    const auto how = lookup::Between(v.choice(between));
    const auto beyond = lookup::Outside(v.choice(outside));
    for (std::ptrdiff_t place = lane; place < static_cast<std::ptrdiff_t>(r.count) * r.lanes; place += r.lanes) {
      for (std::size_t i = 0; i < axes.size(); ++i) axes[i].u = r.u[i][place];
      r.y[0][place] = lookup::value(how, beyond, axes, values_there);
    }
  }
}

std::string Lookup::check(const View<double>& v) {
  for (const double x : v.list(values))
    if (!std::isfinite(x)) return "\"values\" holds a number that is not finite; give a number for every knot";
  return "";
}

Kernel lookup_block() {
  Kernel k = kernel<Lookup>();
  k.instance = &Lookup::instance;
  return k;
}

}  // namespace hysteron::blocks
