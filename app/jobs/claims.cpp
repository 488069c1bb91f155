#include "app/jobs/claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/jobs/job_values.h"
#include "engine/diagram/error.h"
#include "engine/diagram/number_text.h"
#include "report/pages/numbers.h"

namespace hysteron {
namespace {

/// A quantity as the job writes it, held against the value that it is compared with.
struct Written {
  double si = 0;
  Unit unit{};
};

Written read_written(const WrittenText& text, const Quantity& like) {
  double number = 0;
  std::string unit_name;
  if (!split_quantity(text.text, number, unit_name))
    fail("bad_number", text.pointer, fmt::format("\"{}\" is no number with a unit", text.text),
         "write it as \"6.6 um\"");
  const Unit unit = parse_unit(unit_name, text.pointer);
  if (!(unit.dimension == like.unit.dimension))
    fail("wrong_unit", text.pointer,
         fmt::format("the value is in {}, this is in {}", unit_text(like.unit), unit_text(unit)),
         fmt::format("write it in {}", unit_text(like.unit)));
  return {like.difference ? unit.difference_to_si(number) : unit.to_si(number), unit};
}

/// "2 %" of the expected value, or a size in its unit.
double read_tolerance(const WrittenText& text, const Quantity& like, double expected) {
  double number = 0;
  std::string unit_name;
  if (split_quantity(text.text, number, unit_name) && unit_name == "%") return std::abs(expected) * number / 100;
  Quantity size = like;
  size.difference = true;
  return std::abs(read_written(text, size).si);
}

/// "uncompensated_peak" as people read it.
std::string spoken(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

double in_unit(double si, const Quantity& like, const Unit& unit) {
  return like.difference ? unit.difference_from_si(si) : unit.from_si(si);
}

/// The fewest digits, two at least, with which a number stands on the same side of the limit as it does.
int digits_beside(double number, double limit) {
  constexpr int fewest = 2, most = 10;
  int digits = fewest;
  while (digits < most && (rounded_to_digits(number, digits) < limit) != (number < limit)) ++digits;
  return digits;
}

/// In the unit of what is expected, so that both can be compared at a glance.
std::string shown(double number, const Unit& unit, int digits) {
  const std::string text = unit_text(unit);
  return text.empty() ? number_text(number, digits) : number_text(number, digits) + " " + text;
}

void judge_order(JobRunner& runner, const ClaimPart& part, PartOutcome& out) {
  std::vector<std::string> texts;
  out.holds = true;
  double before = 0;
  for (std::size_t i = 0; i < part.order.size(); ++i) {
    const Quantity& q = runner.value(part.order[i]);
    texts.push_back(fmt::format("{} {}", spoken(part.order[i].text), quantity_text(q, 4)));
    if (i > 0 && !(before < q.si)) out.holds = false;
    before = q.si;
  }
  out.came_out = fmt::format("{}", fmt::join(texts, ", "));
  out.expected = "increasing in this order";
}

void judge_value(JobRunner& runner, const ClaimPart& part, PartOutcome& out) {
  const Quantity& value = runner.value(part.value);
  std::vector<std::string> wanted;
  bool near = true;
  Unit unit = value.unit;
  int digits = 2;
  if (part.expected) {
    const Written expected = read_written(*part.expected, value);
    const double tolerance = read_tolerance(*part.tolerance, value, expected.si);
    near = std::abs(value.si - expected.si) <= tolerance;
    unit = expected.unit;
    digits = digits_within(in_unit(value.si, value, unit), in_unit(expected.si - tolerance, value, unit),
                           in_unit(expected.si + tolerance, value, unit));
    wanted.push_back(
        fmt::format("{}{} within {}", part.must_differ ? "not " : "", part.expected->text, part.tolerance->text));
  }
  bool holds = part.must_differ ? !near : near;
  if (part.above) {
    const Written limit = read_written(*part.above, value);
    holds = holds && value.si > limit.si;
    unit = limit.unit;
    digits = std::max(digits, digits_beside(in_unit(value.si, value, unit), in_unit(limit.si, value, unit)));
    wanted.push_back("above " + part.above->text);
  }
  if (part.below) {
    const Written limit = read_written(*part.below, value);
    holds = holds && value.si < limit.si;
    unit = limit.unit;
    digits = std::max(digits, digits_beside(in_unit(value.si, value, unit), in_unit(limit.si, value, unit)));
    wanted.push_back("below " + part.below->text);
  }
  out.holds = holds && std::isfinite(value.si);
  out.came_out = fmt::format("{} {}", spoken(part.value.text), shown(in_unit(value.si, value, unit), unit, digits));
  out.expected = fmt::format("{}", fmt::join(wanted, ", "));
}

ClaimOutcome outcome_of(const PublishedClaim& claim, const std::vector<PartOutcome>& parts) {
  ClaimOutcome o;
  o.claim = claim;
  for (const auto& part : parts)
    if (part.id == claim.id) o.parts.push_back(part);
  const bool all = std::all_of(o.parts.begin(), o.parts.end(), [](const PartOutcome& p) { return p.holds; });
  if (!claim.cannot.empty()) {
    o.outcome = "cannot be checked";
    o.reason = claim.cannot;
  } else if (o.parts.empty()) {
    o.outcome = "cannot be checked";
    o.reason = "no job settles it";
  } else {
    o.outcome = !all ? "differs" : claim.calibrated.empty() ? "agrees" : "calibrated";
  }
  return o;
}

}  // namespace

PartOutcome judge(JobRunner& runner, const ClaimPart& part) {
  PartOutcome out;
  out.job = runner.job().name;
  out.id = part.id;
  out.remark = part.remark;
  runner.at(part.pointer,
            [&] { part.order.empty() ? judge_value(runner, part, out) : judge_order(runner, part, out); });
  if (!part.thesis.empty()) out.expected += fmt::format(" (thesis {})", part.thesis);
  return out;
}

std::vector<ClaimOutcome> judge_all(const std::vector<PublishedClaim>& published, const std::vector<PartOutcome>& parts,
                                    const std::vector<std::string>& prefixes) {
  std::vector<ClaimOutcome> list;
  for (const auto& claim : published) {
    const bool wanted =
        std::any_of(prefixes.begin(), prefixes.end(), [&](const auto& p) { return claim.id.starts_with(p); });
    const bool met = std::any_of(parts.begin(), parts.end(), [&](const auto& p) { return p.id == claim.id; });
    if (wanted || met) list.push_back(outcome_of(claim, parts));
  }
  for (const auto& part : parts) {
    const bool known = std::any_of(list.begin(), list.end(), [&](const auto& o) { return o.claim.id == part.id; });
    if (known) continue;
    PublishedClaim claim;
    claim.id = part.id;
    list.push_back(outcome_of(claim, parts));
  }
  return list;
}

}  // namespace hysteron
