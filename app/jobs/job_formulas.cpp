// The runs of a job that simulate nothing: rows made of values of the job, and rows of a formula.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "app/jobs/job_runs.h"
#include "app/jobs/job_values.h"
#include "engine/diagram/error.h"
#include "fit/estimate/global.h"
#include "fit/estimate/swarm.h"
#include "report/pages/numbers.h"

namespace hysteron {
namespace {

RunColumn column(const std::string& name, const char* unit, std::vector<double> values = {}) {
  return {name, name, parse_unit(unit), std::move(values)};
}

/// A particle that nothing pulls flies straight through the (c, k) plane of the swarm and bounces off its bounds
/// (thesis Fig. 4.1): where it is, and where it would be without bounds.
RunResult reflection() {
  struct Axis {
    double lower, upper, x, v, free;
  };
  // Bounds of thesis Table 4.1; start and velocity are a drawing's: one bounce off each side, and one in a corner's
  // reach.
  std::array<Axis, 2> axes{{{0.001, 0.999, 0.15, 0.07, 0.15}, {0.01, 10, 2, 0.55, 2}}};
  RunResult r;
  r.columns = {column("step", ""),    column("c", ""),        column("k", "V"),      column("free_c", ""),
               column("free_k", "V"), column("lower_k", "V"), column("upper_k", "V")};
  for (int step = 0; step <= 24; ++step) {
    const std::array<double, 7> row{
        static_cast<double>(step), axes[0].x, axes[1].x, axes[0].free, axes[1].free, axes[1].lower, axes[1].upper};
    for (std::size_t i = 0; i < row.size(); ++i) r.columns[i].values.push_back(row[i]);
    for (Axis& a : axes) {
      const double velocity = a.v;
      a.free = a.x + velocity;
      a.x += velocity;
      reflect(a.lower, a.upper, a.x, a.v);
    }
  }
  return r;
}

/// The curves between which parameters of piezo loops lie (thesis Eqs. 4.11, 4.12), for an input from 0 to `top` [V].
struct Band {
  Attractor::Component k;
  explicit Band(double top) : k(piezo_attractor(0, 1, top).components[1]) {}
  double lower(double c) const { return k.scale * sum_of(k.lower, c); }
  double upper(double c) const { return k.scale * sum_of(k.upper, c); }
};

/// One of its curves, c as far as thesis Table 4.1 goes.
RunResult curve_of(const Band& band, bool upper) {
  RunResult r;
  r.columns = {column("c", ""), column("k", "V")};
  for (int i = 0; i <= 200; ++i) {
    const double c = 0.001 + 0.998 * i / 200;
    r.columns[0].values.push_back(c);
    r.columns[1].values.push_back(upper ? band.upper(c) : band.lower(c));
  }
  return r;
}

/// How far inside the band each pair of c and k lies (negative outside).
RunResult inside_of(const Band& band, const RunColumn& base, const std::vector<double>& c,
                    const std::vector<double>& k) {
  RunResult r;
  r.columns = {base, column("inside", "V")};
  for (std::size_t i = 0; i < c.size(); ++i)
    r.columns[1].values.push_back(std::min(k[i] - band.lower(c[i]), band.upper(c[i]) - k[i]));
  return r;
}

}  // namespace

RunResult JobRunner::selected(const RunWish& run) {
  const RunResult& from = result(run.other_run);
  const std::vector<char> keep = kept(run.where, from);
  RunResult r;
  for (const auto& column : from.columns) {
    r.columns.push_back({column.name, column.path, column.unit, {}});
    for (std::size_t i = 0; i < keep.size(); ++i)
      if (keep[i] != 0) r.columns.back().values.push_back(column.values[i]);
  }
  return r;
}

RunResult JobRunner::made_of_values(const RunWish& run) {
  RunResult r;
  for (const auto& wish : run.rows) {
    RunColumn made{wish.name, wish.name, {}, {}};
    for (const auto& cell : wish.cells) {
      const Quantity q = cell.number ? Quantity{si(*cell.number, parse_unit(cell.number->number.unit.value_or(""))),
                                                parse_unit(cell.number->number.unit.value_or(""))}
                                     : value(cell.value);
      if (made.values.empty()) made.unit = q.unit;
      if (!(made.unit.dimension == q.unit.dimension))
        fail("wrong_unit", cell.number ? cell.number->pointer : cell.value.pointer,
             fmt::format("column \"{}\" begins in {}, this is in {}", wish.name, unit_text(made.unit),
                         unit_text(q.unit)),
             "put it into a column of its own");
      made.values.push_back(q.si);
    }
    r.columns.push_back(std::move(made));
  }
  return r;
}

RunResult JobRunner::of_formula(const RunWish& run) {
  if (run.formula.text == "reflection") return reflection();
  if (!run.top)
    fail("missing_key", run.formula.pointer, "the band depends on the largest input", "write \"top\": \"6 V\"");
  const Band band(si(*run.top, parse_unit("V")));
  if (run.formula.text != "piezo_band") return curve_of(band, run.formula.text == "piezo_upper");
  if (!run.of_run)
    fail("missing_key", run.formula.pointer, "nothing says which rows lie inside the band or not",
         "write \"of\": {\"run\": \"near\", \"c\": \"c\", \"k\": \"k\"}");
  const RunResult& from = result(*run.of_run);
  const auto argument = [&](const char* name) -> const RunColumn& {
    for (const auto& [a, signal] : run.of)
      if (a == name) return at(signal.pointer, [&]() -> const RunColumn& { return column_of(from, signal); });
    fail("missing_key", run.of_run->pointer, fmt::format("nothing says which signal is {}", name),
         "write \"of\": {\"run\": \"near\", \"c\": \"model.c\", \"k\": \"model.k\"}");
  };
  return inside_of(band, from.columns.front(), argument("c").values, argument("k").values);
}

}  // namespace hysteron
