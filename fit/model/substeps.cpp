// Decides how finely recordings are simulated: into how many substeps each row is cut. Most rows of a recording need
// few, those at a step of its input many: there a mass rings between two rows of a slow recording, and a play meets
// its corner anywhere. They are chosen once and stay the same for all trials, so that a prediction depends smoothly on
// its parameters.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

#include "engine/diagram/error.h"
#include "fit/model/model_content.h"

namespace hysteron {
namespace {

// Of the tolerance, and of what the worst row makes: by how much the error of a row must differ from that of the row
// before to count as made there. What an earlier row left behind (in a memory, in a slow state) hardly changes.
constexpr double made_here = 0.1;
constexpr int most_pieces = 1024;  // of one row
/// Times the rows that there were when cutting some helped last: so far it goes on where it does not. What happens
/// within a thousandth of a row (a quick lag in a slow recording) shows no smaller error until it is cut that finely,
/// and to cut a few rows costs little beside cutting all.
constexpr double patience = 1.5;

/// What rings between two rows and is gone at the second changes nothing when the row is halved, but a play keeps how
/// far it went. So some rows at which the outputs bend most, and those behind them, are cut this finely to see; if that
/// shows anything, the next ones too, four times as many each time.
constexpr int to_see = 64;
constexpr std::size_t looked_at = 6;  // rows of an output at first

/// Rows cut into so many parts are worth an attempt with fewer that grow.
constexpr int least_graded = 32;

std::vector<RowCut> uncut(const BoundRecording& b) { return std::vector<RowCut>(b.instants().size()); }

double parts_of(const std::vector<RowCut>& rows) {
  return std::accumulate(rows.begin(), rows.end(), 0.0, [](double sum, const RowCut& r) { return sum + r.parts(); });
}

/// Ends of the parts of a way of length 1, but the last one.
std::vector<double> ends_of_parts(const RowCut& row) {
  std::vector<double> ends;
  const int first = row.per_octave > 0 ? std::min(row.per_octave, row.into) : row.into;
  for (int k = 1; k <= std::min(first, row.into - 1); ++k) ends.push_back(static_cast<double>(k) / row.into);
  for (int octave = first; octave < row.into; octave *= 2)
    for (int k = 1; k <= first; ++k) {
      const double end = octave * (1 + static_cast<double>(k) / first) / row.into;
      if (end < 1 - 1e-9) ends.push_back(end);
    }
  return ends;
}

bool is_finite(const std::vector<Rows>& rows) { return !rows.empty(); }

/// The largest difference, in tolerances.
double worst_of(const std::vector<Rows>& coarse, const std::vector<Rows>& fine, std::span<const double> tolerance) {
  if (!is_finite(coarse) || !is_finite(fine)) return std::numeric_limits<double>::infinity();
  double worst = 0;
  for (std::size_t o = 0; o < fine.size(); ++o)
    for (std::size_t i = 0; i < fine[o].size(); ++i)
      worst = std::max(worst, std::abs(fine[o][i] - coarse[o][i]) / std::max(tolerance[o], 1e-300));
  return worst;
}

/// Instants on whose way the error is made, with their neighbours, whose slopes it also hangs on.
std::vector<bool> where_made(const BoundRecording& b, const std::vector<Rows>& coarse, const std::vector<Rows>& fine,
                             std::span<const double> tolerance) {
  std::vector<bool> made(b.instants().size(), false);
  if (!is_finite(coarse) || !is_finite(fine)) return made;
  for (std::size_t o = 0; o < fine.size(); ++o) {
    std::vector<double> more(fine[o].size());
    for (std::size_t i = 0; i < more.size(); ++i)
      more[i] = std::abs(fine[o][i] - coarse[o][i] - (i == 0 ? 0 : fine[o][i - 1] - coarse[o][i - 1]));
    const double most = more.empty() ? 0 : *std::max_element(more.begin(), more.end());
    for (std::size_t i = 0; i < more.size(); ++i) {
      if (!(more[i] > made_here * std::max(most, tolerance[o]))) continue;
      const std::size_t k = b.at[o][i];
      for (std::size_t j = k > 0 ? k - 1 : 0; j < std::min(k + 2, made.size()); ++j) made[j] = true;
    }
  }
  return made;
}

/// The pieces of each row, twice as many where the error is made; empty where that is nowhere in particular.
std::vector<RowCut> with_more_pieces(const BoundRecording& b, const std::vector<bool>& made) {
  auto rows = b.pieces.empty() ? uncut(b) : b.pieces;
  std::size_t more = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!made[i] || rows[i].into * b.substeps >= most_pieces) continue;
    ++more;
    rows[i].into *= 2;
    rows[i].per_octave *= 2;
  }
  return more > 0 && 2 * more < rows.size() ? rows : std::vector<RowCut>{};
}

/// Instants where an output bends most, and the two behind each, of those that are not all cut finely yet: a step of
/// the input bends it where its ramp begins, and where it ends the plant rings.
std::vector<bool> where_it_bends(const BoundRecording& b, const std::vector<Rows>& rows, std::size_t most) {
  std::vector<bool> bends(b.instants().size(), false);
  for (std::size_t o = 0; o < rows.size(); ++o) {
    const Rows& y = rows[o];
    const auto is_coarse = [&](std::size_t i) { return b.pieces.empty() || b.pieces[b.at[o][i]].into < to_see; };
    std::vector<std::pair<double, std::size_t>> bend;
    for (std::size_t i = 1; i + 2 < y.size(); ++i)
      if (is_coarse(i + 1)) bend.emplace_back(std::abs(y[i + 1] - 2 * y[i] + y[i - 1]), i);
    const std::size_t n = std::min(most, bend.size());
    std::partial_sort(bend.begin(), bend.begin() + static_cast<std::ptrdiff_t>(n), bend.end(), std::greater<>());
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = bend[j].second; i < bend[j].second + 3; ++i) bends[b.at[o][i]] = true;
  }
  return bends;
}

/// The pieces of each row, enough to see where it is chosen, as far as rows are cut at all.
std::vector<RowCut> cut_there(const BoundRecording& b, const std::vector<bool>& chosen) {
  auto rows = b.pieces.empty() ? uncut(b) : b.pieces;
  const int finely = std::min(to_see, most_pieces / b.substeps);
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (chosen[i] && rows[i].into < finely) rows[i] = {finely, 0};
  return rows;
}

/// Where a model leaves much more than the noise, rows that are exact to the noise only cost time.
std::vector<double> no_finer_than(double share, const BoundRecording& b, const std::vector<Rows>& made,
                                  std::span<const double> tolerance) {
  std::vector<double> list(tolerance.begin(), tolerance.end());
  if (share <= 0 || !is_finite(made)) return list;
  for (std::size_t o = 0; o < made.size(); ++o) {
    double sum = 0, squares = 0;
    const auto n = static_cast<double>(made[o].size());
    for (std::size_t i = 0; i < made[o].size(); ++i) {
      const double left = (*b.measured[o])[i] - made[o][i];
      sum += left;
      squares += left * left;
    }
    if (n > 0) list[o] = std::max(list[o], share * std::sqrt(std::max(0.0, squares / n - sum / n * (sum / n))));
  }
  return list;
}

}  // namespace

int RowCut::parts() const {
  return per_octave == 0 || into <= per_octave ? into : static_cast<int>(ends_of_parts(*this).size()) + 1;
}

/// The way to instant i as into[i] says; nothing is cut where it is empty.
void BoundRecording::cut(std::vector<RowCut> into) {
  pieces = std::move(into);
  place.clear();
  if (pieces.empty()) {
    rows = evaluated;
    return;
  }
  std::vector<double> all;
  all.reserve(static_cast<std::size_t>(parts_of(pieces)));
  for (std::size_t i = 0; i < instants().size(); ++i) {
    const double before = i == 0 ? instants()[0] : instants()[i - 1], way = instants()[i] - before;
    if (i > 0 && pieces[i].into > 1)
      for (const double end : ends_of_parts(pieces[i])) all.push_back(before + way * end);
    place.push_back(all.size());
    all.push_back(instants()[i]);
  }
  rows = std::make_shared<const std::vector<double>>(std::move(all));
}

std::vector<RowCut> BoundRecording::all_pieces() const {
  auto all = pieces.empty() ? uncut(*this) : pieces;
  for (auto& row : all) {
    row.into *= substeps;
    row.per_octave *= substeps;
  }
  return all;
}

void BoundRecording::keep_instants(std::vector<std::vector<double>>& computed) const {
  if (place.empty()) return;
  for (auto& of_signal : computed) {
    for (std::size_t i = 0; i < place.size(); ++i) of_signal[i] = of_signal[place[i]];
    of_signal.resize(place.size());
  }
}

/// A quick lag in a slow recording has come to its end soon after each row: parts that grow with the time since then
/// show it with a tenth of their number. Taken where they show the same as `fine`, which parts of one length made.
void DataModel::Content::grade(int r, std::span<const ParameterValue> values, const std::vector<Rows>& fine,
                               std::span<const double> tolerance) {
  BoundRecording& b = bound[static_cast<std::size_t>(r)];
  const auto pieces = b.pieces, all = b.all_pieces();
  const int substeps = b.substeps;
  for (const int per_octave : {2, 4}) {
    auto graded = all;
    for (auto& row : graded)
      if (row.per_octave == 0 && row.into >= least_graded) row.per_octave = per_octave;
    if (2 * parts_of(graded) > parts_of(all)) return;
    b.cut(graded);
    b.substeps = 1;
    std::vector<Rows> seen;
    try {
      seen = one(r, values, 1, false);
    } catch (const std::exception&) {  // it runs away: not fine enough
    }
    if (worst_of(fine, seen, tolerance) <= 1) return;
    b.cut(pieces);
    b.substeps = substeps;
  }
}

/// From the substeps that it has upwards. `begun_with_known`: these were chosen for another model, and go where they do
/// not suffice as they are: which rows the corners of a play or a delay fall into hangs on all values, and rows that
/// were cut for some of them would pile up.
SubstepsFound DataModel::Content::choose_substeps(int r, std::span<const ParameterValue> values,
                                                  std::span<const double> asked, bool begun_with_known) {
  BoundRecording& b = bound[static_cast<std::size_t>(r)];
  SubstepsFound found;
  // Nonlinear states may run away where steps are too long for them: that is a result that is not fine enough.
  const auto rows_with = [&](int substeps) {
    std::vector<Rows> rows;
    try {
      rows = one(r, values, substeps, false);
    } catch (const Error& error) {
      found.ran_away = found.ran_away || error.problems.front().code == "diverged";
    } catch (const std::exception&) {
    }
    return rows;
  };
  auto coarse = rows_with(b.substeps);
  std::size_t look_at = looked_at;
  double worst_before = std::numeric_limits<double>::infinity();
  double when_it_helped = static_cast<double>(b.rows->size());
  const auto most = static_cast<std::size_t>(options.max_substeps) * b.instants().size();
  while (static_cast<std::size_t>(b.substeps) * b.rows->size() < most) {
    auto fine = rows_with(2 * b.substeps);
    const auto tolerance = no_finer_than(options.substep_share, b, fine, asked);
    // The error falls at least in proportion to the step, so what changed by halving it is more than what is left.
    const double worst = worst_of(coarse, fine, tolerance);
    if (std::exchange(begun_with_known, false) && worst > 1) {
      b.cut({});
      coarse = rows_with(b.substeps);
      when_it_helped = static_cast<double>(b.rows->size());
      continue;
    }
    if (worst <= 1) {
      const auto pieces = b.pieces;
      b.cut(cut_there(b, where_it_bends(b, fine, look_at)));
      auto seen = rows_with(b.substeps);
      // Cut more finely, any row shows up to twice what halving it showed, ringing or not.
      if (worst_of(coarse, seen, tolerance) > std::max(1.0, 2 * worst)) {
        coarse = std::move(seen);
        look_at *= 4;
        continue;
      }
      b.cut(pieces);
      grade(r, values, fine, tolerance);
      found.suffice = found.simulated = true;
      return found;
    }
    auto into = with_more_pieces(b, where_made(b, coarse, fine, tolerance));
    if (worst < 0.7 * worst_before) when_it_helped = static_cast<double>(b.rows->size());
    worst_before = worst;
    // Where cutting some rows does not help, the error comes from elsewhere.
    if (into.empty() || parts_of(into) > patience * when_it_helped) {
      b.substeps *= 2;
      coarse = std::move(fine);
      when_it_helped = static_cast<double>(b.rows->size());
    } else {
      b.cut(std::move(into));
      coarse = rows_with(b.substeps);
    }
  }
  found.simulated = is_finite(coarse);
  return found;
}

std::vector<RowCut> DataModel::Content::cuts_to_begin_with(int r) const {
  if (!options.begin_with || static_cast<std::size_t>(r) >= options.begin_with->size()) return {};
  const auto& known = (*options.begin_with)[static_cast<std::size_t>(r)];
  return known.size() == bound[static_cast<std::size_t>(r)].instants().size() ? known : std::vector<RowCut>{};
}

std::vector<std::string> DataModel::choose_substeps(std::span<const ParameterValue> values,
                                                    std::span<const double> noise, bool only_finer) {
  Content& c = *content_;
  std::vector<std::string> remarks;
  if (!c.not_exact.empty() || !c.needs_substeps) {
    c.substeps_chosen = true;
    return remarks;
  }
  auto& last = c.substeps_chosen_at;
  if (!only_finer && last && std::ranges::equal(last->values, values) && std::ranges::equal(last->noise, noise))
    return last->remarks;
  last.reset();
  std::vector<double> tolerance(c.outputs.size());
  for (std::size_t o = 0; o < tolerance.size(); ++o)
    tolerance[o] = std::max(c.options.substep_tolerance * c.spans[o], noise.empty() ? 0.0 : noise[o] / 1000);
  bool all = true;
  for (int r = 0; r < n_recordings(); ++r) {
    BoundRecording& b = c.bound[static_cast<std::size_t>(r)];
    const bool anew = !only_finer || !b.simulated;
    if (anew) {
      b.cut(c.cuts_to_begin_with(r));
      b.substeps = 1;
    }
    const auto found = c.choose_substeps(r, values, tolerance, anew && !b.pieces.empty());
    b.simulated = found.simulated;
    if (c.options.bdf_otherwise && !found.suffice && b.advance->integrates() && (found.simulated || found.ran_away)) {
      c.not_exact = fmt::format("{}: {} substeps per row do not suffice for its nonlinear states", recording(r).name,
                                c.options.max_substeps);
      c.substeps_chosen = true;
      return remarks;
    }
    if (!found.suffice && !found.simulated) {
      // At values where it can be simulated this is done again.
      all = false;
      b.cut({});
      b.substeps = c.options.max_substeps;
      continue;
    }
    if (!found.suffice)
      remarks.push_back(fmt::format("{}: {} substeps per row do not suffice for the tolerance asked for",
                                    recording(r).name, c.options.max_substeps));
  }
  // Each time costs more than a hundred simulations; what runs away at three points is searched with what was found.
  c.substeps_chosen = all || ++c.failed_choices >= 3;
  if (!only_finer && all) last = {{values.begin(), values.end()}, {noise.begin(), noise.end()}, remarks};
  return remarks;
}

int DataModel::substeps(int recording) const {
  int most = 1;
  for (const auto& row : content_->bound[static_cast<std::size_t>(recording)].all_pieces())
    most = std::max(most, row.into);
  return most;
}

Cuts DataModel::cuts() const {
  Cuts all;
  for (const auto& b : content_->bound) {
    auto& rows = all.emplace_back(b.all_pieces());
    // As they are, rows pass many at once; parts of which each is a row would have to be picked out again.
    if (std::none_of(rows.begin(), rows.end(), [](const RowCut& r) { return r.into > 1; })) rows.clear();
  }
  return all;
}

long DataModel::steps(int recording) const {
  const BoundRecording& b = content_->bound[static_cast<std::size_t>(recording)];
  const auto rows = static_cast<double>(b.rows ? b.rows->size() : b.instants().size());
  return std::lround(rows * b.points_per_instant * b.substeps);
}

}  // namespace hysteron
