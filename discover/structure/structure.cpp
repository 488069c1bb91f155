// Decides which generic structure stands out in a residual. See structure.h.
//
// Each structure is fitted by linear least squares on whitened columns and judged on validation recordings; the one
// that takes away most wins.
#include "discover/structure/structure.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "discover/structure/residual_parts.h"
#include "discover/structure/structure_breaks.h"
#include "discover/structure/structure_lines.h"

namespace hysteron {
namespace {

constexpr double as_much = 0.01;  // of what a structure takes away

std::string sentence_of(const Structure& s, Where where) {
  const std::string share = fmt::format("{:.0f} % of what stands above the noise {}", 100 * s.share_removed,
                                        where == Where::validation ? "on validation recordings" : "in all recordings");
  if (s.kind == "line_in_time")
    return fmt::format("a line at {:.4g} Hz{} in the residual of {} holds {}", 1 / s.period,
                       s.harmonic > 0 ? fmt::format(", {} times the frequency of the drive,", s.harmonic) : "",
                       s.output, share);
  if (s.kind == "line_in_level")
    return fmt::format("a ripple over {} with period {:.4g} {} holds {}", s.variable,
                       s.unit.difference_from_si(s.period), s.unit.text, share);
  if (s.kind == "kink_at_level")
    return fmt::format("a kink at {} = {:.4g} {} holds {}", s.variable, s.unit.from_si(s.threshold), s.unit.text,
                       share);
  std::size_t n = 0;
  for (const auto& [name, list] : s.intervals) n += list.size();
  if (s.kind == "bursts")
    return fmt::format("{} bursts in the residual of {} in {} recordings hold {}", n, s.output, s.intervals.size(),
                       share);
  if (s.has_threshold)
    return fmt::format("{} jumps of the residual of {}, all at {} = {:.4g} {}, hold {}", n, s.output, s.variable,
                       s.unit.from_si(s.threshold), s.unit.text, share);
  return fmt::format("{} jumps of the residual of {} in {} recordings, at no common level, hold {}", n, s.output,
                     s.intervals.size(), share);
}

/// Where a gain and an offset leave hardly more than noise, there is nothing that a structure could hold.
void weigh(Structure& s, const ResidualParts& parts, Where where) {
  s.beyond_calibration = parts.beyond();
  const double beyond = over(parts.beyond(), where), floor = over(parts.floor(), where);
  const double excess = (beyond > rules::floor_gate * floor ? beyond : over(parts.before(), where)) - floor;
  s.share_removed = excess > 0 ? std::min(1.0, over(s.fall, where) / excess) : 0;
}

/// Over a drive and over what follows it at once a structure is the same but for a few rows: then all recordings say
/// which of the two it is.
bool holds_more(const Structure& a, const Structure& b, Where where) {
  const double more = over(a.fall, where) - over(b.fall, where);
  return std::abs(more) > as_much * over(b.fall, where) ? more > 0 : a.fall.all() > b.fall.all();
}

/// Adds what was found in the residual of one output.
void search_output(StructureSearch& search, const Evidence& evidence, const Prediction& prediction, int output,
                   const Threads& threads, Where where) {
  const ResidualParts parts(evidence, prediction, output);
  int best = -1;
  const auto at = [&](int i) -> const Structure& { return search.list[static_cast<std::size_t>(i)]; };
  const auto offer = [&](std::optional<Structure> s) {
    if (!s) return;
    weigh(*s, parts, where);
    s->output = evidence.model().outputs()[static_cast<std::size_t>(output)];
    s->sentence = sentence_of(*s, where);
    search.list.push_back(std::move(*s));
    const int last = static_cast<int>(search.list.size()) - 1;
    if (over(at(last).fall, where) > 0 && (best < 0 || holds_more(at(last), at(best), where))) best = last;
  };
  if (parts.list().empty() || over(parts.beyond(), where) <= 0) return;
  std::vector<std::function<std::optional<Structure>()>> kinds{[&] { return line_in_time(parts); }};
  for (std::size_t level = 0; level < parts.levels().size(); ++level) {
    kinds.emplace_back([&parts, level] { return line_in_level(parts, level); });
    kinds.emplace_back([&parts, level] { return kink_at_level(parts, level); });
  }
  kinds.emplace_back([&] { return jumps(parts); });
  std::vector<std::optional<Structure>> found(kinds.size());
  threads.each(kinds.size(), [&](std::size_t i) { found[i] = kinds[i](); });
  for (auto& s : found) offer(std::move(s));
  // Bursts are told where nothing else holds: they say when, and explain nothing.
  if (best < 0 || at(best).share_removed <= rules::structure_share) offer(bursts(parts));
  if (best >= 0 && (search.best < 0 || over(at(best).fall, where) > over(search.winner()->fall, where)))
    search.best = best;
}

}  // namespace

StructureSearch find_structures(const Evidence& evidence, const Prediction& prediction, const Threads& threads,
                                Where where) {
  StructureSearch search;
  for (int o = 0; o < static_cast<int>(evidence.model().outputs().size()); ++o)
    search_output(search, evidence, prediction, o, threads, where);
  return search;
}

}  // namespace hysteron
