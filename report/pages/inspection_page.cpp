#include "report/pages/inspection_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "discover/selection/check.h"
#include "engine/diagram/time_text.h"
#include "report/pages/numbers.h"

namespace hysteron {
namespace {

std::string clock_text(const Clock& clock) {
  if (!clock.regular) return fmt::format("not uniform, {} .. {}", time_text(clock.shortest), time_text(clock.longest));
  std::string text = time_text(clock.step);
  if (!clock.uniform) text += fmt::format(", jitter {}", percent_text(clock.jitter));
  if (clock.missing() > 0) text += fmt::format(", {} missing", count_text(clock.missing(), "row"));
  return text;
}

Table columns_table(const Inspection& data) {
  Table table;
  table.title = "Columns";
  table.columns = {"column", "is", "unit", "lowest", "highest", "finest step", "scatter, rms"};
  for (const auto& c : data.columns)
    table.rows.push_back({c.name, c.role, unit_text(c.unit).empty() ? "1" : unit_text(c.unit),
                          quantity_text(c.lowest, c.unit), quantity_text(c.highest, c.unit),
                          c.finest > 0 ? difference_text(c.finest, c.unit) : "-",
                          difference_text(c.roughness, c.unit, 3)});
  return table;
}

Table recordings_table(const Inspection& data) {
  Table table;
  table.title = "Recordings";
  table.columns = {"recording", "role",      "rows",  "duration",     "sampling interval", "input",
                   "range",     "band [Hz]", "turns", "stroke sizes", "longest hold",      "periods"};
  for (const auto& r : data.recordings) {
    const std::vector<std::string> head{r.name, to_text(r.role), std::to_string(r.rows), time_text(r.duration),
                                        clock_text(r.clock)};
    if (r.drives.empty()) {
      table.rows.push_back(head);
      table.rows.back().resize(table.columns.size(), "-");
      table.rows.back()[5] = "nothing moves";
    }
    for (const auto& d : r.drives) {
      table.rows.push_back(head);
      for (const auto& cell :
           {d.input, quantity_text(d.lowest, d.unit, 3) + " .. " + quantity_text(d.highest, d.unit, 3),
            d.band.highest > 0 ? number_text(d.band.lowest, 3) + " .. " + number_text(d.band.highest, 3) : "-",
            std::to_string(d.reversals), std::to_string(d.swings), d.hold.length > 0 ? time_text(d.hold.length) : "-",
            d.period.found()
                ? fmt::format("{} of {}", number_text(d.period.count(), 3), time_text(d.period.rows * r.clock.step))
                : "-"})
        table.rows.back().push_back(cell);
    }
  }
  return table;
}

Table repeats_table(const Inspection& data) {
  Table table;
  table.title = "What was recorded twice";
  table.columns = {"output", "what", "rows", "repeatability, rms", "without the offset"};
  constexpr std::size_t shown = 12;
  for (const auto& r : data.repeats)
    if (table.rows.size() < shown)
      table.rows.push_back({r.output, r.what, std::to_string(r.floor.rows), difference_text(r.floor.rms, r.unit, 3),
                            difference_text(r.floor.without_offset, r.unit, 3)});
  return table;
}

std::vector<std::string> visible_ids(const Inspected& seen) {
  std::vector<std::string> ids;
  for (const auto& e : seen.effects)
    if (e.can_well()) ids.push_back(e.effect);
  return ids;
}

/// "hysteresis (swings of one size ...)": what these data show, though not well.
std::vector<std::string> unsure_ids(const Inspected& seen) {
  std::vector<std::string> ids;
  for (const auto& e : seen.effects)
    if (e.can() && !e.can_well()) ids.push_back(fmt::format("{} ({})", e.effect, e.unsure));
  return ids;
}

Table visible_table(const Inspected& seen) {
  Table table;
  table.title = "What these data can show";
  table.columns = {"effect", "what it is", "where it could enter", "what they leave open"};
  for (const auto& e : seen.effects)
    if (e.can()) table.rows.push_back({e.effect, e.title, fmt::format("{}", fmt::join(e.places, ", ")), e.unsure});
  return table;
}

Table hidden_table(const Inspected& seen) {
  Table table;
  table.title = "What these data cannot show";
  table.columns = {"effect", "what it is", "why"};
  for (const auto& e : seen.effects)
    if (!e.can()) table.rows.push_back({e.effect, e.title, e.reason});
  return table;
}

Facts facts_of(const InspectedDrive& d, double step) {
  Facts facts = Facts::object({{"input", d.input},
                               {"unit", unit_text(d.unit)},
                               {"lowest", d.unit.from_si(d.lowest)},
                               {"highest", d.unit.from_si(d.highest)},
                               {"fastest_per_s", d.unit.difference_from_si(d.fastest)},
                               {"reversals", d.reversals},
                               {"swing_sizes", d.swings},
                               {"longest_hold_s", d.hold.length}});
  if (d.band.highest > 0) facts.set("band_hz", Facts::List{d.band.lowest, d.band.highest});
  if (d.period.found()) {
    facts.set("period_s", d.period.rows * step);
    facts.set("periods", d.period.count());
  }
  return facts;
}

Facts facts_of(const InspectedRecording& r) {
  Facts::List gaps, drives;
  for (const auto& gap : r.clock.gaps) gaps.push_back(Facts::object({{"time_s", gap.time}, {"rows", gap.missing}}));
  for (const auto& d : r.drives) drives.push_back(facts_of(d, r.clock.step));
  return Facts::object({{"recording", r.name},
                        {"role", to_text(r.role)},
                        {"rows", r.rows},
                        {"duration_s", r.duration},
                        {"step_s", r.clock.step},
                        {"uniform", r.clock.uniform},
                        {"jitter", r.clock.jitter},
                        {"missing_rows", r.clock.missing()},
                        {"gaps", gaps},
                        {"drives", drives}});
}

Facts facts_of(const InspectedColumn& c) {
  Facts facts = Facts::object({{"column", c.name},
                               {"is", c.role},
                               {"unit", unit_text(c.unit)},
                               {"lowest", c.unit.from_si(c.lowest)},
                               {"highest", c.unit.from_si(c.highest)},
                               {"roughness_rms", c.unit.difference_from_si(c.roughness)}});
  if (c.finest > 0) facts.set("finest_step", c.unit.difference_from_si(c.finest));
  return facts;
}

}  // namespace

Inspected inspect_data(const Diagram& diagram, const Registry& registry, DataModel& model, const Effects& effects,
                       const std::vector<std::string>& free_paths, bool diagram_is_meant) {
  return {inspect(model, {free_paths, diagram_is_meant}),
          visible_effects(diagram, with_both_roles(model.data()), registry, effects, free_paths)};
}

std::string inspection_headline(const Inspected& seen) {
  const auto& faults = seen.data.faults;
  if (faults.empty()) return "No problem found in the data.";
  return fmt::format("{} in the data. {}{}", count_text(static_cast<long>(faults.size()), "problem"),
                     faults.size() > 1 ? "First: " : "", faults.front());
}

std::vector<std::string> inspection_sentences(const Inspected& seen) {
  std::vector<std::string> sentences = seen.data.sentences;
  sentences.insert(sentences.end(), seen.data.notes.begin(), seen.data.notes.end());
  if (seen.effects.empty()) return sentences;
  const auto ids = visible_ids(seen), unsure = unsure_ids(seen);
  if (ids.empty() && unsure.empty()) sentences.emplace_back("These data can show no effect.");
  if (!ids.empty()) sentences.push_back(fmt::format("These data can show {}.", fmt::join(ids, ", ")));
  if (!unsure.empty())
    sentences.push_back(fmt::format("They can show, but not tell for sure: {}.", fmt::join(unsure, "; ")));
  std::vector<std::string> placeless;
  for (const auto& e : seen.effects)
    if (e.needs_block)
      placeless.push_back(e.effect);
    else if (!e.can())
      sentences.push_back(fmt::format("They cannot show {}: {}.", e.effect, e.reason));
  if (!placeless.empty())
    sentences.push_back(fmt::format("The diagram has no block for {}.", fmt::join(placeless, ", ")));
  return sentences;
}

Section inspection_section(const Inspected& seen) {
  Section section;
  section.title = "The data";
  section.text = seen.data.faults;
  section.text.insert(section.text.end(), seen.data.sentences.begin(), seen.data.sentences.end());
  section.text.insert(section.text.end(), seen.data.notes.begin(), seen.data.notes.end());
  for (auto& table : {columns_table(seen.data), recordings_table(seen.data), repeats_table(seen.data),
                      hidden_table(seen), visible_table(seen)})
    if (!table.rows.empty()) section.tables.push_back(table);
  return section;
}

Facts inspection_facts(const Inspected& seen) {
  Facts::List columns, recordings, repeats, lines, cuts, between, can, cannot;
  for (const auto& c : seen.data.columns) columns.push_back(facts_of(c));
  for (const auto& r : seen.data.recordings) recordings.push_back(facts_of(r));
  for (const auto& r : seen.data.repeats)
    repeats.push_back(Facts::object({{"output", r.output},
                                     {"what", r.what},
                                     {"unit", unit_text(r.unit)},
                                     {"rows", r.floor.rows},
                                     {"rms", r.unit.difference_from_si(r.floor.rms)},
                                     {"rms_without_offset", r.unit.difference_from_si(r.floor.without_offset)}}));
  for (const auto& l : seen.data.lines)
    lines.push_back(Facts::object({{"output", l.output},
                                   {"frequency_hz", l.frequency},
                                   {"amplitude", l.unit.difference_from_si(l.amplitude)},
                                   {"unit", unit_text(l.unit)},
                                   {"recordings", l.recordings}}));
  for (const auto& c : seen.data.cuts)
    cuts.push_back(Facts::object({{"input", c.input},
                                  {"end", c.at_top ? "highest" : "lowest"},
                                  {"level", c.unit.from_si(c.level)},
                                  {"would_be", c.unit.from_si(c.would_be)},
                                  {"unit", unit_text(c.unit)},
                                  {"tops", c.tops},
                                  {"recordings", c.recordings}}));
  for (const auto& b : seen.data.between)
    between.push_back(Facts::object({{"input", b.input},
                                     {"given", to_text(b.given)},
                                     {"better", to_text(b.better)},
                                     {"error_share_removed", b.fall}}));
  for (const auto& e : seen.effects)
    if (e.can()) {
      Facts facts = Facts::object({{"effect", e.effect}, {"places", e.places}});
      if (!e.unsure.empty()) facts.set("leaves_open", e.unsure);
      can.push_back(std::move(facts));
    } else {
      cannot.push_back(Facts::object({{"effect", e.effect}, {"reason", e.reason}}));
    }
  return Facts::object({{"columns", columns},
                        {"recordings", recordings},
                        {"repeats", repeats},
                        {"lines", lines},
                        {"cut_inputs", cuts},
                        {"between_samples", between},
                        {"faults", seen.data.faults},
                        {"notes", seen.data.notes},
                        {"can_show", can},
                        {"cannot_show", cannot}});
}

}  // namespace hysteron
