#include "discover/hypotheses/effect_content.h"

#include <fmt/format.h>

#include "discover/hypotheses/effect_terms.h"
#include "engine/diagram/number_text.h"

namespace hysteron {
namespace {

void put(Node& block, const Diagram& diagram, const std::string& path, const Number& number) {
  const auto [name, index] = list_and_index(path);
  if (index < 0) {
    block.parameters[name] = Value(number);
    return;
  }
  Value& value = block.parameters[name];
  if (!std::holds_alternative<NumberList>(value.content)) value = diagram.parameters.find(name)->value;
  std::get<NumberList>(value.content)[static_cast<std::size_t>(index)] = number;
}

}  // namespace

/// "times[0]" -> {"times", 0}; "tau" -> {"tau", -1}.
std::pair<std::string, int> list_and_index(const std::string& path) {
  const auto open = path.find('[');
  if (open == std::string::npos || path.back() != ']') return {path, -1};
  const std::string digits = path.substr(open + 1, path.size() - open - 2);
  const bool whole =
      !digits.empty() && digits.size() < 4 && digits.find_first_not_of("0123456789") == std::string::npos;
  return {path.substr(0, open), whole ? leading_whole_number(digits, -2) : -2};
}

Law law_of(const EffectContent& c, const Excitation& at) {
  Law law;
  law.name = c.law_name;
  law.block.type = "diagram";
  law.block.file = c.file;
  law.block.nested = c.diagram;
  for (const auto& [path, quantity] : c.fixed) put(law.block, *c.diagram, path, quantity.number(at));
  for (const auto& f : c.free) {
    put(law.block, *c.diagram, f.path, f.start.number(at));
    LawParameter p;
    p.path = f.program_path.empty() ? f.path : f.program_path;
    p.start = f.start.si(at);
    if (f.lower) p.lower = f.lower->si(at);
    if (f.upper) p.upper = f.upper->si(at);
    p.log_scale = f.log_scale;
    p.per_recording = f.per_recording;
    if (f.usual_lower) p.plausible_lower = f.usual_lower->si(at);
    if (f.usual_upper) p.plausible_upper = f.usual_upper->si(at);
    for (const auto& q : f.scan) p.scan.push_back(q.si(at));
    if (f.scan_from && f.scan_to && f.scan_from->si(at) > 0 && f.scan_to->si(at) > f.scan_from->si(at))
      p.scan = effects::per_decade(f.scan_from->si(at), f.scan_to->si(at), f.per_decade);
    law.free.push_back(std::move(p));
  }
  return law;
}

std::string why_unseen(const EffectContent& c, const Excitation& at) {
  const std::string wanted = c.diagram->inputs.find("in")->unit;
  if (!wanted.empty() && !at.unit.text.empty() &&
      dimension_factor(at.unit.dimension, parse_unit(wanted).dimension) == 0)
    return fmt::format("the wire is in {}, the effect acts on a signal in {}", at.unit.text, wanted);
  if (!at.from_data) return "";
  if (auto still = effects::stands_still(at); !still.empty()) return still;
  const EffectNeeds& n = c.needs;
  if (n.range && at.range() < n.range->si(at))
    return fmt::format("the signal spans {:.3g} {}, the effect needs {:.3g} {}", at.unit.difference_from_si(at.range()),
                       at.unit.text, at.unit.difference_from_si(n.range->si(at)), at.unit.text);
  if (n.hold && at.longest_hold < n.hold->si(at))
    return fmt::format("longest hold {}, needs {}", effects::time_text(at.longest_hold),
                       effects::time_text(n.hold->si(at)));
  if (n.side_range && at.side_highest - at.side_lowest < n.side_range->si(at))
    return fmt::format("the signal beside it spans {:.3g} {}, the effect needs {:.3g}",
                       at.side_unit.difference_from_si(at.side_highest - at.side_lowest), at.side_unit.text,
                       at.side_unit.difference_from_si(n.side_range->si(at)));
  if (at.reversals < n.reversals)
    return fmt::format("the signal turns {} times, the effect needs {}", at.reversals, n.reversals);
  if (at.recordings < n.recordings)
    return fmt::format("{} recordings, the effect needs {}", at.recordings, n.recordings);
  const double little = 1e-3 * at.range();  // rounding of a drive that ends at zero is no sign
  if (n.changes_sign && (at.lowest > -little || at.highest < little)) return "the signal does not change its sign";
  return "";
}

std::string summary_of(const EffectContent& c, const Law& law, const std::vector<double>& values,
                       const Excitation& at) {
  std::string text = c.says;
  for (std::size_t i = 0; i < law.free.size() && i < values.size(); ++i) {
    const std::string name = "{" + c.free[i].path + "}";
    const Number start = c.free[i].start.number(at);
    const Unit unit = start.unit ? parse_unit(*start.unit) : Unit{};
    const std::string value =
        fmt::format("{:.3g}{}{}", unit.from_si(values[i]), unit.text.empty() ? "" : " ", unit.text);
    for (auto where = text.find(name); where != std::string::npos; where = text.find(name))
      text.replace(where, name.size(), value);
  }
  return text;
}

}  // namespace hysteron
