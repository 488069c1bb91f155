// Where the squared error lies: each split puts every row into exactly one part, so its shares add up to one.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "fit/branches.h"
#include "fit/compare.h"

namespace hysteron {
namespace {

/// One split being made: names of the parts, how a sentence speaks of them, and the part of each row.
struct Draft {
  std::string variable, title;
  std::vector<std::string> labels, phrases;
  std::vector<std::vector<int>> part;  ///< [recording][row]
};

std::string number(const Unit& unit, double si) {
  const double x = unit.from_si(si);
  return fmt::format("{:.3g}", std::abs(x) < 1e-300 ? 0.0 : x);
}
std::string with_unit(const std::string& text, const std::string& unit) {
  return unit.empty() ? text : text + " " + unit;
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
  if (n > 0)
    s.sentence = fmt::format("{:.0f} % of the squared error lies {}, which holds {:.0f} % of the rows",
                             100 * s.parts[top].error, d.phrases[top], 100 * s.parts[top].rows);
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
      d.phrases.push_back(fmt::format("in the {} fifth of each recording", ordinals[k]));
    }
  }
  for (const auto& r : recordings) {
    const double begin = r.t->front(), length = r.t->back() - begin;
    std::vector<int> part;
    for (const double t : *r.t)
      part.push_back(length > 0 ? std::clamp(static_cast<int>(5 * (t - begin) / length), 0, 4) : 0);
    d.part.push_back(std::move(part));
  }
  return d;
}

Draft by_level(const std::vector<SplitInput>& recordings, const std::string& name, const Unit& unit) {
  Draft d{"level", "by level of " + name, {}, {}, {}};
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const auto& r : recordings)
    for (const double u : *r.u) {
      low = std::min(low, u);
      high = std::max(high, u);
    }
  const double width = (high - low) / 5;
  for (int k = 0; k < 5; ++k) {
    d.labels.push_back(with_unit(
        fmt::format("{} .. {}", number(unit, low + k * width), number(unit, low + (k + 1) * width)), unit.text));
    d.phrases.push_back(fmt::format("where {} is {}", name, d.labels.back()));
  }
  for (const auto& r : recordings) {
    std::vector<int> part;
    for (const double u : *r.u) part.push_back(width > 0 ? std::clamp(static_cast<int>((u - low) / width), 0, 4) : 0);
    d.part.push_back(std::move(part));
  }
  return d;
}

Draft by_branch(const std::vector<std::vector<Branch>>& branch, const std::string& name) {
  Draft d{"branch",
          "by branch of " + name,
          {"rising", "falling", "hold"},
          {"on the rising branch", "on the falling branch", fmt::format("where {} is held", name)},
          {}};
  for (const auto& rows : branch) {
    std::vector<int> part;
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
    for (std::size_t i = 0; i < u.size() && u.size() > 1; ++i) {
      const std::size_t a = i > 0 ? i - 1 : 0, b = std::min(i + 1, u.size() - 1);
      v[i] = std::abs((u[b] - u[a]) / (t[b] - t[a]));
      if (branch[r][i] != Branch::hold) moving.push_back(v[i]);
    }
    rate.push_back(std::move(v));
  }
  std::sort(moving.begin(), moving.end());
  std::vector<double> edges;  // thirds of the rows that move, equal edges only once
  for (const std::size_t k : {moving.size() / 3, 2 * moving.size() / 3})
    if (k < moving.size() && moving[k] > moving.front() * (1 + 1e-6) &&
        (edges.empty() || moving[k] > edges.back() * (1 + 1e-6)))
      edges.push_back(moving[k]);
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
    const std::size_t end = first_cycle_end(*r.u);
    std::vector<int> part(r.u->size(), 1);
    std::fill(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(end), 0);
    d.part.push_back(std::move(part));
  }
  return d;
}

}  // namespace

std::vector<Split> splits_of(const std::vector<SplitInput>& recordings, const std::string& input_name,
                             const Unit& input_unit) {
  std::vector<Split> splits;
  if (recordings.empty()) return splits;
  const auto add = [&](const Draft& d) { splits.push_back(finish(d, recordings)); };
  if (recordings.size() > 1) add(by_recording(recordings));
  add(by_time(recordings));
  const bool has_input = std::all_of(recordings.begin(), recordings.end(), [](auto& r) { return r.u != nullptr; });
  if (has_input) {
    std::vector<std::vector<Branch>> branch;
    for (const auto& r : recordings) branch.push_back(branches(*r.u));
    add(by_level(recordings, input_name, input_unit));
    add(by_branch(branch, input_name));
    add(by_rate(recordings, branch, input_name, input_unit));
    add(by_cycle(recordings));
  }
  std::stable_sort(splits.begin(), splits.end(), [](auto& a, auto& b) { return a.information > b.information; });
  return splits;
}

}  // namespace hysteron
