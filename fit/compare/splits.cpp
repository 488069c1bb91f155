// Where the squared error lies: each split puts every row into exactly one part, so its shares add up to one.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "fit/compare/compare.h"
#include "fit/compare/holds.h"
#include "fit/signals/branches.h"
#include "fit/signals/row_checks.h"
#include "fit/signals/whiten.h"

namespace hysteron {
namespace {

/// One split being made: names of the parts, how a sentence speaks of them, and the part of each row.
struct Draft {
  std::string variable, title;
  std::vector<std::string> labels, phrases;
  std::vector<std::vector<int>> part;      ///< [recording][row]
  std::string counted = "of the samples";  ///< what its parts are shares of, beside the error
  bool has_times = true;                   ///< its parts are rows
};

std::string number(const Unit& unit, double si) {
  const double x = unit.from_si(si);
  return fmt::format("{:.3g}", std::abs(x) < 1e-300 ? 0.0 : x);
}
std::string with_unit(const std::string& text, const std::string& unit) {
  return unit.empty() ? text : text + " " + unit;
}

/// A part that holds hardly more of the error than of the rows says nothing of where it lies.
constexpr double tells_nothing = 0.05;

std::string share_text(double share) {
  return share > 0 && share < 0.005 ? fmt::format("{:.2g} %", 100 * share) : fmt::format("{:.0f} %", 100 * share);
}

void add_spans(Split& s, const Draft& d, const std::vector<SplitInput>& recordings) {
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    auto spans = spans_of(*recordings[r].t, d.part[r], s.parts.size());
    for (std::size_t p = 0; p < s.parts.size(); ++p)
      if (!spans[p].empty()) s.parts[p].spans.push_back({recordings[r].name, std::move(spans[p])});
  }
}

Split finish(const Draft& d, const std::vector<SplitInput>& recordings) {
  Split s;
  s.variable = d.variable;
  s.title = d.title;
  const std::size_t n = d.labels.size();
  std::vector<double> squared(n, 0.0), rows(n, 0.0);
  for (std::size_t r = 0; r < recordings.size(); ++r)
    for (std::size_t i = 0; i < recordings[r].residual->size(); ++i) {
      const auto p = static_cast<std::size_t>(d.part[r][i]);
      const double e = (*recordings[r].residual)[i];
      squared[p] += e * e;
      rows[p] += 1;
    }
  const double total = std::accumulate(squared.begin(), squared.end(), 0.0);
  const double all = std::accumulate(rows.begin(), rows.end(), 0.0);
  std::size_t top = 0;
  for (std::size_t p = 0; p < n; ++p) {
    SplitPart part;
    part.label = d.labels[p];
    part.rows = all > 0 ? rows[p] / all : 0;
    part.error = total > 0 ? squared[p] / total : part.rows;  // no error at all: spread as the rows are
    part.rms = rows[p] > 0 ? std::sqrt(squared[p] / rows[p]) : 0;
    if (part.error > 0 && part.rows > 0) s.information += part.error * std::log(part.error / part.rows);
    s.parts.push_back(std::move(part));
    if (s.parts[p].error - s.parts[p].rows > s.parts[top].error - s.parts[top].rows) top = p;
  }
  if (n == 0) return s;
  if (d.has_times) add_spans(s, d, recordings);
  const SplitPart& most = s.parts[top];
  s.tells = most.error - most.rows >= tells_nothing;
  s.sentence = s.tells ? fmt::format("{:.0f} % of the squared error lies {} ({} {})", 100 * most.error, d.phrases[top],
                                     share_text(most.rows), d.counted)
                       : fmt::format("Split {}, the squared error is spread as the samples are", d.title);
  return s;
}

Draft by_recording(const std::vector<SplitInput>& recordings) {
  Draft d{"recording", "by recording", {}, {}, {}};
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    d.labels.push_back(recordings[r].name);
    d.phrases.push_back("in " + recordings[r].name);
    d.part.emplace_back(recordings[r].residual->size(), static_cast<int>(r));
  }
  return d;
}

/// Fifths of each recording's own time: drift and creep grow along it, whatever its length.
Draft by_time(const std::vector<SplitInput>& recordings) {
  Draft d{"time", "by time", {}, {}, {}};
  const bool one = recordings.size() == 1;
  const char* ordinals[] = {"first", "second", "third", "fourth", "last"};
  for (int k = 0; k < 5; ++k) {
    if (one) {
      const double begin = recordings[0].t->front(), length = recordings[0].t->back() - begin;
      d.labels.push_back(fmt::format("{:.4g} .. {:.4g} s", begin + 0.2 * k * length, begin + 0.2 * (k + 1) * length));
      d.phrases.push_back("in the time " + d.labels.back());
    } else {
      d.labels.push_back(fmt::format("{} fifth", ordinals[k]));
      d.phrases.push_back(fmt::format("in the {} fifth of the recordings' time, all together", ordinals[k]));
    }
  }
  for (const auto& r : recordings) {
    const double begin = r.t->front(), length = r.t->back() - begin;
    std::vector<int> part;
    part.reserve(r.t->size());
    for (const double t : *r.t)
      part.push_back(length > 0 ? std::clamp(static_cast<int>(5 * (t - begin) / length), 0, 4) : 0);
    d.part.push_back(std::move(part));
  }
  return d;
}

/// Fifths of the range of a signal, given per recording.
Draft by_level(const std::vector<const Rows*>& signal, const std::string& variable, const std::string& name,
               const Unit& unit) {
  Draft d{variable, "by level of " + name, {}, {}, {}};
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Rows* rows : signal)
    for (const double u : *rows) {
      low = std::min(low, u);
      high = std::max(high, u);
    }
  const double width = (high - low) / 5;
  for (int k = 0; k < 5; ++k) {
    d.labels.push_back(with_unit(
        fmt::format("{} .. {}", number(unit, low + k * width), number(unit, low + (k + 1) * width)), unit.text));
    d.phrases.push_back(fmt::format("where {} is {}", name, d.labels.back()));
  }
  for (const Rows* rows : signal) {
    std::vector<int> part;
    part.reserve(rows->size());
    for (const double u : *rows) part.push_back(width > 0 ? std::clamp(static_cast<int>((u - low) / width), 0, 4) : 0);
    d.part.push_back(std::move(part));
  }
  return d;
}

/// What a further signal is, by its unit.
std::string kind_of(const Unit& unit) {
  if (unit.dimension == parse_unit("K").dimension) return "temperature";
  return unit.dimension == parse_unit("N").dimension ? "force" : "other_axis";
}

Draft by_branch(const std::vector<std::vector<Branch>>& branch, const std::string& name) {
  Draft d{"branch",
          "by branch of " + name,
          {"rising", "falling", "hold"},
          {"on the rising branch", "on the falling branch", fmt::format("where {} is held", name)},
          {}};
  for (const auto& rows : branch) {
    std::vector<int> part;
    part.reserve(rows.size());
    for (const Branch b : rows) part.push_back(b == Branch::rising ? 0 : b == Branch::falling ? 1 : 2);
    d.part.push_back(std::move(part));
  }
  return d;
}

Draft by_rate(const std::vector<SplitInput>& recordings, const std::vector<std::vector<Branch>>& branch,
              const std::string& name, const Unit& unit) {
  Draft d{"rate", fmt::format("by rate of {}", name), {}, {}, {}};
  std::vector<std::vector<double>> rate;
  std::vector<double> moving;
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    const Rows &u = *recordings[r].u, &t = *recordings[r].t;
    std::vector<double> v(u.size(), 0.0);
    moving.reserve(moving.size() + u.size());
    for (std::size_t i = 0; i < u.size() && u.size() > 1; ++i) {
      const std::size_t a = i > 0 ? i - 1 : 0, b = std::min(i + 1, u.size() - 1);
      v[i] = std::abs((u[b] - u[a]) / (t[b] - t[a]));
      if (branch[r][i] != Branch::hold) moving.push_back(v[i]);
    }
    rate.push_back(std::move(v));
  }
  std::vector<double> edges;  // thirds of the rows that move, equal edges only once
  const double slowest = moving.empty() ? 0 : *std::min_element(moving.begin(), moving.end());
  for (const std::size_t k : {moving.size() / 3, 2 * moving.size() / 3}) {
    if (k >= moving.size()) continue;
    std::nth_element(moving.begin(), moving.begin() + static_cast<std::ptrdiff_t>(k), moving.end());
    if (moving[k] > slowest * (1 + 1e-6) && (edges.empty() || moving[k] > edges.back() * (1 + 1e-6)))
      edges.push_back(moving[k]);
  }
  moving = {};
  const auto text = [&](double si) {
    const std::string per = unit.text.empty() ? "1/s" : unit.text + "/s";
    return fmt::format("{:.3g} {}", unit.difference_from_si(si), per);
  };
  d.labels = {"held"};
  d.phrases = {fmt::format("where {} is held", name)};
  for (std::size_t k = 0; k <= edges.size(); ++k) {
    d.labels.push_back(edges.empty()       ? std::string("moving")
                       : k == 0            ? "below " + text(edges[0])
                       : k == edges.size() ? "above " + text(edges[k - 1])
                                           : fmt::format("{} .. {}", text(edges[k - 1]), text(edges[k])));
    d.phrases.push_back(edges.empty()       ? fmt::format("where {} moves", name)
                        : k == 0            ? fmt::format("where {} moves slower than {}", name, text(edges[0]))
                        : k == edges.size() ? fmt::format("where {} moves faster than {}", name, text(edges[k - 1]))
                                            : fmt::format("where {} moves at {}", name, d.labels.back()));
  }
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    std::vector<int> part;
    part.reserve(rate[r].size());
    for (std::size_t i = 0; i < rate[r].size(); ++i)
      part.push_back(
          branch[r][i] == Branch::hold
              ? 0
              : 1 + static_cast<int>(std::upper_bound(edges.begin(), edges.end(), rate[r][i]) - edges.begin()));
    d.part.push_back(std::move(part));
  }
  return d;
}

Draft by_cycle(const std::vector<SplitInput>& recordings) {
  Draft d{"cycle", "by cycle", {"first cycle", "later"}, {"in the first cycle", "after the first cycle"}, {}};
  for (const auto& r : recordings) {
    const std::size_t end = first_cycle_end(*r.u, turning_threshold(*r.u, r.rough));
    std::vector<int> part(r.u->size(), 1);
    std::fill(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(end), 0);
    d.part.push_back(std::move(part));
  }
  return d;
}

/// A part for each decade between the ends; `before` parts stand in front. Names "below", "to", "above" a power of ten.
struct Decades {
  int lowest = 0, highest = 0;
  int of(double x) const {
    return std::clamp(static_cast<int>(std::floor(std::log10(std::max(x, 1e-300)))), lowest, highest) - lowest;
  }
  int count() const { return highest - lowest + 1; }
  std::string label(int k, const std::string& unit) const {
    const double from = std::pow(10, lowest + k);
    if (k == 0) return fmt::format("below {:.6g} {}", 10 * from, unit);
    if (k == count() - 1) return fmt::format("above {:.6g} {}", from, unit);
    return fmt::format("{:.6g} .. {:.6g} {}", from, 10 * from, unit);
  }
  /// "in the first 0.01 s after u has stopped"
  std::string phrase(int k, const std::string& event) const {
    const double from = std::pow(10, lowest + k);
    if (k == 0) return fmt::format("in the first {:.6g} s after {}", 10 * from, event);
    if (k == count() - 1) return fmt::format("later than {:.6g} s after {}", from, event);
    return fmt::format("{:.6g} .. {:.6g} s after {}", from, 10 * from, event);
  }
};

/// By the swing that a row belongs to: thirds of the largest between two turning points.
Draft by_amplitude(const std::vector<SplitInput>& recordings, const std::string& name) {
  Draft d{"amplitude",
          "by size of stroke of " + name,
          {"small strokes", "middle strokes", "large strokes"},
          {fmt::format("in strokes of {} below 1/3 of the largest", name),
           fmt::format("in strokes of {} of 1/3 to 2/3 of the largest", name),
           fmt::format("in strokes of {} over 2/3 of the largest", name)},
          {}};
  std::vector<Rows> swing;
  double largest = 0;
  for (const auto& r : recordings) {
    const Rows& u = *r.u;
    Rows size(u.size(), 0.0);
    auto ends = turning_points(u, turning_threshold(u, r.rough));
    if (!u.empty()) ends.push_back(u.size() - 1);
    std::size_t begin = 0;
    for (const std::size_t end : ends) {
      for (std::size_t i = begin; i <= end; ++i) size[i] = std::abs(u[end] - u[begin]);
      largest = std::max(largest, std::abs(u[end] - u[begin]));
      begin = end;
    }
    swing.push_back(std::move(size));
  }
  for (const auto& rows : swing) {
    std::vector<int> part;
    part.reserve(rows.size());
    for (const double s : rows) part.push_back(largest > 0 ? std::clamp(static_cast<int>(3 * s / largest), 0, 2) : 0);
    d.part.push_back(std::move(part));
  }
  return d;
}

/// By the time for which the input has been held, in decades from the first row of a hold to its longest.
Draft by_hold_time(const Holds& holds, const std::string& name) {
  Draft d{"hold_time", fmt::format("by the time for which {} has been held", name), {"moving"}, {}, {}};
  d.phrases = {fmt::format("where {} moves", name)};
  Decades decades;
  if (holds.longest > 0) {
    decades.highest = static_cast<int>(std::floor(std::log10(holds.longest)));
    decades.lowest = std::max(decades.highest - 3, static_cast<int>(std::floor(std::log10(holds.shortest))));
  }
  for (int k = 0; k < decades.count(); ++k) {
    d.labels.push_back(decades.label(k, "s"));
    d.phrases.push_back(decades.phrase(k, name + " has stopped"));
  }
  for (const auto& rows : holds.age) {
    std::vector<int> part;
    part.reserve(rows.size());
    for (const double a : rows) part.push_back(a < 0 ? 0 : 1 + decades.of(a));
    d.part.push_back(std::move(part));
  }
  return d;
}

/// What grows during holds is told of all of them together: "78 % of the squared error lies in the 40 s after a step,
/// growing with log time".
void tell_growth(Split& split, const Holds& holds, const std::vector<SplitInput>& recordings, const std::string& name) {
  const SplitPart& moving = split.parts.front();
  if (moving.error > moving.rows) return;  // it is not in the holds that the error lies
  const std::string growth = growth_of(holds, recordings);
  if (growth.empty()) return;
  split.tells = true;
  split.sentence = fmt::format("{:.0f} % of the squared error lies in the {:.3g} s after {} ({} of the samples){}",
                               100 * (1 - moving.error), holds.longest,
                               holds.after_step >= holds.after_motion ? "a step" : name + " has stopped",
                               share_text(1 - moving.rows), growth);
}

/// By frequency, in decades: the squares of the cosines of each recording's residual add up to those of its rows. The
/// mean belongs to the lowest.
Split by_frequency(const std::vector<SplitInput>& recordings) {
  Draft d{"frequency", "by frequency of the residual", {}, {}, {}};
  d.counted = "of the spectrum";
  d.has_times = false;
  std::vector<Rows> cosines;
  std::vector<double> grid;  // [Hz] between cosines
  double highest = 0;
  for (const auto& r : recordings) {
    cosines.push_back(*r.residual);
    cosine_transform(cosines.back());
    grid.push_back(1 / (2 * static_cast<double>(cosines.back().size()) * clock_of(*r.t).step));
    highest = std::max(highest, grid.back() * static_cast<double>(cosines.back().size()));
  }
  Decades decades;
  decades.highest = static_cast<int>(std::floor(std::log10(highest)));
  decades.lowest = decades.highest - 4;
  for (int k = 0; k < decades.count(); ++k) {
    d.labels.push_back(decades.label(k, "Hz"));
    d.phrases.push_back("at frequencies " + d.labels.back());
  }
  std::vector<SplitInput> spectra = recordings;
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    std::vector<int> part;
    part.reserve(cosines[r].size());
    for (std::size_t k = 0; k < cosines[r].size(); ++k) part.push_back(decades.of(grid[r] * static_cast<double>(k)));
    d.part.push_back(std::move(part));
    spectra[r].residual = &cosines[r];
  }
  Split split = finish(d, spectra);
  // Of a band the rms is what it adds to that of the whole residual.
  double squares = 0, rows = 0;
  for (const auto& r : recordings)
    for (const double e : *r.residual) squares += e * e, rows += 1;
  for (auto& part : split.parts) part.rms = rows > 0 ? std::sqrt(part.error * squares / rows) : 0;
  return split;
}

/// Parts that hold rows.
long used_parts(const Split& s) {
  return std::count_if(s.parts.begin(), s.parts.end(), [](const SplitPart& p) { return p.rows > 0; });
}

}  // namespace

std::vector<Split> splits_of(std::vector<SplitInput> recordings, const std::string& input_name, const Unit& input_unit,
                             const std::vector<SplitSignal>& besides) {
  std::vector<Split> splits;
  if (recordings.empty()) return splits;
  for (auto& r : recordings)
    if (r.u != nullptr && r.rough < 0) r.rough = roughness(*r.u);
  const auto add = [&](const Draft& d) { splits.push_back(finish(d, recordings)); };
  if (recordings.size() > 1) add(by_recording(recordings));
  add(by_time(recordings));
  const bool has_input = std::all_of(recordings.begin(), recordings.end(), [](auto& r) { return r.u != nullptr; });
  if (has_input) {
    std::vector<std::vector<Branch>> branch;
    for (const auto& r : recordings) branch.push_back(branches(*r.u, r.rough));
    std::vector<const Rows*> inputs;
    for (const auto& r : recordings) inputs.push_back(r.u);
    add(by_level(inputs, "level", input_name, input_unit));
    add(by_branch(branch, input_name));
    add(by_rate(recordings, branch, input_name, input_unit));
    add(by_cycle(recordings));
    // Only where the data have it: swings of different size, and holds.
    if (Split s = finish(by_amplitude(recordings, input_name), recordings); used_parts(s) > 1)
      splits.push_back(std::move(s));
    const Holds holds = holds_of(recordings, branch);
    if (Split s = finish(by_hold_time(holds, input_name), recordings); used_parts(s) > 1) {
      tell_growth(s, holds, recordings, input_name);
      splits.push_back(std::move(s));
    }
  }
  for (const auto& signal : besides) {
    std::vector<const Rows*> rows;
    for (const auto& r : signal.rows) rows.push_back(&r);
    add(by_level(rows, kind_of(signal.unit), signal.name, signal.unit));
  }
  std::stable_sort(splits.begin(), splits.end(), [](auto& a, auto& b) { return a.information > b.information; });
  // Behind the others: nearly every residual is slow beside its clock, which would always be said first.
  if (std::all_of(recordings.begin(), recordings.end(),
                  [](auto& r) { return r.residual->size() > 16 && clock_of(*r.t).regular; }))
    splits.push_back(by_frequency(recordings));
  return splits;
}

std::vector<SplitSignal> telling_signals(std::vector<SplitSignal> signals, const std::vector<Rows>& u) {
  // The same limit at which a coupling from another axis can no longer be told from the drive (cross_coupling).
  constexpr double alike = 0.9;
  std::erase_if(signals, [&](const SplitSignal& signal) {
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0;
    const double x0 = signal.rows.empty() || signal.rows.front().empty() ? 0 : signal.rows.front().front();
    for (std::size_t r = 0; r < signal.rows.size(); ++r)
      for (std::size_t i = 0; i < signal.rows[r].size(); ++i) {
        const double x = signal.rows[r][i] - x0, y = r < u.size() ? u[r][i] : 0;
        n += 1;
        sx += x;
        sy += y;
        sxx += x * x;
        sxy += x * y;
        syy += y * y;
      }
    const double xx = sxx - sx * sx / n, yy = syy - sy * sy / n, xy = sxy - sx * sy / n;
    const bool moves = std::isfinite(xx) && xx > 1e-12 * (sxx + n * x0 * x0);
    return !moves || (yy > 0 && std::abs(xy) > alike * std::sqrt(xx * yy));
  });
  return signals;
}

}  // namespace hysteron
