// Decides how an effect stands in a JSON file: its diagram is read as any diagram, the member "effect" here.
#include "discover/hypotheses/effect_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>

#include "discover/hypotheses/effect_quantity.h"
#include "discover/hypotheses/effect_terms.h"
#include "discover/wiring/wiring.h"
#include "engine/diagram/error.h"
#include "engine/diagram/number_text.h"
#include "engine/program/program.h"
#include "io/diagram/diagram_file.h"
#include "io/diagram/place_kinds.h"
#include "io/json/json_reader.h"

namespace hysteron {
namespace {

/// The words of the menu of experiments.
const std::vector<std::string> experiments{"zero_run",
                                           "precycle",
                                           "triangle",
                                           "sine_amplitudes",
                                           "step_hold",
                                           "multisine",
                                           "low_frequencies",
                                           "high_frequencies",
                                           "fast_steps",
                                           "temperature_staircase",
                                           "temperature_constant",
                                           "axes_independent",
                                           "repeat_after_cycles",
                                           "reference_sensor",
                                           "load_pair",
                                           "monitor"};

const std::map<std::string, Side> side_ports{
    {"temperature", Side::temperature}, {"force", Side::force}, {"use", Side::use}, {"other_axis", Side::other_axis}};

/// One free number as the file says it; "times[0]" is an element of the parameter "times".
struct FreeNumber {
  std::string path;
  std::string program_path{};  ///< "tau[0]" where the block that reads the number "tau" takes a list
  EffectQuantity start;
  std::optional<EffectQuantity> lower{}, upper{}, usual_lower{}, usual_upper{};
  std::vector<EffectQuantity> scan{};
  std::optional<EffectQuantity> scan_from{}, scan_to{};
  double per_decade = 3;
  bool log_scale = false, per_recording = false;
};

/// What recordings must have so that the effect can be seen in them.
struct Needs {
  std::string text;
  std::optional<EffectQuantity> range{}, hold{}, side_range{};
  int reversals = 0, recordings = 0;
  bool changes_sign = false;
};

/// What laws(), unseen() and summary() of the effect work with.
struct Content {
  std::string file, law_name, says;
  std::shared_ptr<const Diagram> diagram;
  std::vector<FreeNumber> free;
  std::vector<std::pair<std::string, EffectQuantity>> fixed;
  Needs needs;
};

/// "times[0]" -> {"times", 0}; "tau" -> {"tau", -1}.
std::pair<std::string, int> list_and_index(const std::string& path) {
  const auto open = path.find('[');
  if (open == std::string::npos || path.back() != ']') return {path, -1};
  const std::string digits = path.substr(open + 1, path.size() - open - 2);
  const bool whole =
      !digits.empty() && digits.size() < 4 && digits.find_first_not_of("0123456789") == std::string::npos;
  return {path.substr(0, open), whole ? leading_whole_number(digits, -2) : -2};
}

class EffectReader {
 public:
  EffectReader(const std::string& file, std::shared_ptr<const Diagram> diagram) : file_(file), diagram_(diagram) {
    content_.file = file;
    content_.diagram = std::move(diagram);
  }

  Effect read() {
    const JsonPlace root = file_.root();
    effect_.title = diagram_->title;
    effect_.source = diagram_->source;
    for (const char* key : {"title", "source"})
      (void)root.need(key, key[0] == 't' ? "write what the effect is called, for people"
                                         : "write where the law is known from: a paper, a book, a data sheet");
    ports(root);
    const auto place =
        root.need("effect", "write \"effect\": {\"id\": ..., \"enters_at\": [\"command\"], \"free\": {...}}");
    if (place && place->expect_object("{\"id\": \"my_effect\", \"enters_at\": [\"command\"], \"free\": {...}}"))
      members(*place);
    file_.throw_if_any();
    return std::move(effect_);
  }
  const Content& content() const { return content_; }

 private:
  void ports(const JsonPlace& root) {
    const auto names = diagram_->inputs.names();
    if (names.empty() || names.front() != "in" || names.size() > 2 ||
        (names.size() == 2 && !side_ports.contains(names[1])))
      root.find("inputs").value_or(root).add(
          "wrong_ports",
          fmt::format("the inputs of an effect are \"in\" and perhaps one beside it, found: {}",
                      names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))),
          "write \"inputs\": {\"in\": {}}; beside it may stand temperature, force, use or other_axis");
    else if (names.size() == 2)
      effect_.side = side_ports.at(names[1]);
    if (diagram_->outputs.names() != std::vector<std::string>{"out"})
      root.find("outputs").value_or(root).add("wrong_ports", "the only output of an effect is \"out\"",
                                              "write \"outputs\": {\"out\": \"name of a block\"}");
  }

  void members(const JsonPlace& place) {
    place.only({"id", "cause", "equation", "residual", "enters_at", "behind_core", "moves_zero", "law", "free", "fixed",
                "needs", "look_alikes", "contains", "says"});
    if (const auto id = place.need("id", "write \"id\": \"my_effect\""))
      if (const auto text = id->text(); text && check_name(*id, *text, "an effect"))
        effect_.id = effect_.family = *text;
    for (const auto& [key, to] : {std::pair{"cause", &effect_.cause}, {"equation", &effect_.equation}})
      if (const auto text = place.need(key, fmt::format("write \"{}\": \"...\", for people", key)))
        *to = text->text().value_or("");
    effect_.residual = text_member(place, "residual");
    enters_at(place);
    effect_.behind_core = truth(place, "behind_core");
    effect_.moves_zero = truth(place, "moves_zero");
    content_.law_name = text_member(place, "law");
    if (content_.law_name.empty()) content_.law_name = "own law";
    free(place);
    if (const auto fixed = place.find("fixed"); fixed && fixed->expect_object("{\"reference\": \"1 side_middle\"}"))
      for (const auto& [name, value] : fixed->members())
        if (known_parameter(value, name))
          if (const auto q = quantity(value)) content_.fixed.emplace_back(name, *q);
    needs(place);
    look_alikes(place);
    if (const auto list = place.find("contains"); list && list->expect_array("[\"saturation\"]"))
      for (const auto& one : list->elements()) effect_.contains.push_back(one.text().value_or(""));
    says(place);
  }

  static bool truth(const JsonPlace& place, const char* key) {
    const auto member = place.find(key);
    return member && member->truth().value_or(false);
  }

  void enters_at(const JsonPlace& place) {
    const auto list = place.need(
        "enters_at", "write \"enters_at\": [\"command\"], of: " + fmt::format("{}", fmt::join(place_kinds, ", ")));
    if (!list || !list->expect_array("[\"command\", \"measured\"]")) return;
    for (const auto& one : list->elements()) {
      const auto kind = one.text();
      if (!kind) continue;
      if (std::find(place_kinds.begin(), place_kinds.end(), *kind) == place_kinds.end())
        one.add("bad_value", fmt::format("\"{}\" is no kind of place", *kind), did_you_mean(*kind, place_kinds));
      effect_.places.push_back(*kind);
    }
    if (effect_.places.empty())
      list->add("missing_key", "an effect enters somewhere", "name a kind of place: \"command\"");
  }

  std::optional<EffectQuantity> quantity(const JsonPlace& place) const {
    if (place.is_number()) return EffectQuantity(place.number().value_or(0));
    const auto text = place.text();
    if (!text) return {};
    try {
      return EffectQuantity(*text, "");
    } catch (const Error& e) {
      for (const auto& p : e.problems)
        place.add(p.code, p.what, p.cure + fmt::format("; words: {}", fmt::join(EffectQuantity::words(), ", ")));
    }
    return {};
  }
  std::optional<EffectQuantity> quantity(const JsonPlace& object, const char* key) const {
    const auto place = object.find(key);
    return place ? quantity(*place) : std::nullopt;
  }

  bool known_parameter(const JsonPlace& place, const std::string& path) const {
    const auto [name, index] = list_and_index(path);
    const DiagramParameter* parameter = diagram_->parameters.find(name);
    if (parameter == nullptr) {
      place.add("unknown_parameter", fmt::format("the diagram of the effect has no parameter \"{}\"", name),
                diagram_->parameters.empty() ? "give it one: \"parameters\": {\"" + name + "\": 1}"
                                             : did_you_mean(name, diagram_->parameters.names()));
      return false;
    }
    const auto* list = std::get_if<NumberList>(&parameter->value.content);
    const int length = list != nullptr ? static_cast<int>(list->size()) : -1;
    if ((length < 0 && index == -1) || (length > index && index >= 0)) return true;
    place.add("unknown_parameter",
              length < 0 ? fmt::format("\"{}\" is one number, no list", name)
                         : fmt::format("\"{}\" is a list of {} numbers", name, length),
              length < 0 ? fmt::format("write \"{}\"", name)
                         : fmt::format("write \"{}[0]\" .. \"{}[{}]\"", name, name, length - 1));
    return false;
  }

  void free(const JsonPlace& place) {
    const auto list = place.need("free", "write \"free\": {\"tau\": {\"meaning\": ..., \"start\": \"1 row\"}}");
    if (!list || !list->expect_object("{\"tau\": {\"meaning\": \"time constant\", \"start\": \"1 row\"}}")) return;
    for (const auto& [path, one] : list->members())
      if (known_parameter(one, path) && one.expect_object("{\"meaning\": \"time constant\", \"start\": \"1 row\"}"))
        free_number(path, one);
    if (list->members().empty())
      list->add("missing_key", "an effect without a free number cannot be fitted", "name a parameter of the diagram");
  }

  void free_number(const std::string& path, const JsonPlace& place) {
    place.only({"meaning", "start", "lower", "upper", "scan", "log_scale", "usual", "usual_source", "per_recording"});
    FreeNumber f;
    f.path = path;
    const auto meaning = place.need("meaning", "write what the number is, for people");
    const auto start = place.need("start", "write where a fit begins: \"start\": \"0.1 range\"");
    if (!start) return;
    if (const auto q = quantity(*start)) f.start = *q;
    f.lower = quantity(place, "lower");
    f.upper = quantity(place, "upper");
    f.log_scale = truth(place, "log_scale");
    f.per_recording = truth(place, "per_recording");
    if (const auto scan = place.find("scan")) read_scan(*scan, f);
    std::string range;
    if (const auto usual = place.find("usual"); usual && usual->expect_array("[\"1 us\", \"1 ms\"]")) {
      const auto ends = usual->elements();
      if (ends.size() != 2) {
        usual->add_wrong_type("two numbers such as [\"1 us\", \"1 ms\"]");
      } else {
        f.usual_lower = quantity(ends[0]);
        f.usual_upper = quantity(ends[1]);
        range = fmt::format("{} .. {}", written(ends[0]), written(ends[1]));
        const std::string source = text_member(place, "usual_source");
        if (!source.empty()) range += " (" + source + ")";
      }
    }
    check_order(place, f);
    effect_.parameters.push_back({path, f.start.relative() ? unit_in_diagram(path) : f.start.unit().text,
                                  meaning ? meaning->text().value_or("") : "", range});
    content_.free.push_back(std::move(f));
  }

  /// The unit in which the diagram writes a parameter; of a plain number it is that of what starts it.
  std::string unit_in_diagram(const std::string& path) const {
    const auto [name, index] = list_and_index(path);
    const Value& value = diagram_->parameters.find(name)->value;
    const auto* number = std::get_if<Number>(&value.content);
    if (const auto* list = std::get_if<NumberList>(&value.content); list != nullptr && index >= 0)
      number = &(*list)[static_cast<std::size_t>(index)];
    return number != nullptr && number->unit ? *number->unit : "as the wire says";
  }

  static std::string written(const JsonPlace& place) {
    return place.is_text() ? *place.text() : fmt::format("{:g}", place.number().value_or(0));
  }

  void read_scan(const JsonPlace& place, FreeNumber& f) const {
    if (place.is_array()) {
      for (const auto& one : place.elements())
        if (const auto q = quantity(one)) f.scan.push_back(*q);
      return;
    }
    if (!place.expect_object("{\"from\": \"0.1 row\", \"to\": \"0.1 recording\", \"per_decade\": 3}")) return;
    place.only({"from", "to", "per_decade"});
    for (const char* key : {"from", "to"}) (void)place.need(key, "write the first and the last value");
    f.scan_from = quantity(place, "from");
    f.scan_to = quantity(place, "to");
    f.per_decade = number_member(place, "per_decade").value_or(3);
    if (!(f.per_decade > 0 && f.per_decade <= 20))
      place.add("bad_value", "\"per_decade\" is not between 0 and 20", "write 3");
  }

  /// The numbers of one parameter have one dimension, and the start lies between the bounds; what depends on the wire
  /// is known only there.
  static void check_order(const JsonPlace& place, const FreeNumber& f) {
    const Excitation nowhere;
    const auto plain = [](const std::optional<EffectQuantity>& q) { return q && !q->relative(); };
    for (const auto& [key, q] : {std::pair{"lower", &f.lower}, {"upper", &f.upper}}) {
      if (!plain(*q) || f.start.relative()) continue;
      if (!((*q)->unit().dimension == f.start.unit().dimension)) {
        place.find(key)->add(
            "wrong_unit",
            fmt::format("\"{}\" is in \"{}\", the start in \"{}\"", key, (*q)->unit().text, f.start.unit().text),
            "write both in one unit");
      } else if (key[0] == 'l' ? (*q)->si(nowhere) > f.start.si(nowhere) : (*q)->si(nowhere) < f.start.si(nowhere)) {
        place.find(key)->add("bad_value", "the start does not lie between the bounds", "move the bound or the start");
      }
    }
    if (f.log_scale && plain(f.lower) && f.lower->si(nowhere) <= 0)
      place.find("lower")->add("bad_value", "a number searched on a logarithmic scale is above zero",
                               "give a lower bound above zero, or leave \"log_scale\" out");
    if (f.log_scale && !f.lower)
      place.add("missing_key", "a logarithmic scale needs a lower bound above zero", "add \"lower\"");
  }

  void needs(const JsonPlace& place) {
    const auto needs = place.need("needs", "write \"needs\": {\"text\": \"which data show it\"}");
    if (!needs || !needs->expect_object("{\"text\": \"holds of 10 s\", \"hold\": \"10 s\"}")) return;
    needs->only({"text", "range", "hold", "side_range", "reversals", "recordings", "changes_sign"});
    Needs& n = content_.needs;
    if (const auto text = needs->need("text", "say which data show the effect, for people"))
      n.text = text->text().value_or("");
    effect_.needs = n.text;
    n.range = quantity(*needs, "range");
    n.hold = quantity(*needs, "hold");
    n.side_range = quantity(*needs, "side_range");
    n.reversals = static_cast<int>(number_member(*needs, "reversals").value_or(0));
    n.recordings = static_cast<int>(number_member(*needs, "recordings").value_or(0));
    n.changes_sign = truth(*needs, "changes_sign");
    if (n.side_range && effect_.side == Side::none)
      needs->find("side_range")
          ->add("bad_value", "the effect reads nothing beside the wire",
                "give its diagram an input temperature, force, use or other_axis");
  }

  void look_alikes(const JsonPlace& place) {
    const auto list = place.need("look_alikes",
                                 "name what is easily taken for it: [{\"effect\": \"saturation\", \"experiment\": "
                                 "\"triangle\", \"decides\": \"...\"}]");
    if (!list ||
        !list->expect_array("[{\"effect\": \"saturation\", \"experiment\": \"triangle\", \"decides\": \"...\"}]"))
      return;
    for (const auto& one : list->elements()) {
      if (!one.expect_object("{\"effect\": \"saturation\", \"experiment\": \"triangle\", \"decides\": \"...\"}"))
        continue;
      one.only({"effect", "experiment", "decides"});
      const auto effect = one.need("effect", "name the other effect");
      const auto experiment = one.need("experiment", "name the experiment that separates them");
      const auto decides = one.need("decides", "say what decides between them");
      LookAlike l{effect ? effect->text().value_or("") : "", experiment ? experiment->text().value_or("") : "",
                  decides ? decides->text().value_or("") : ""};
      if (experiment && std::find(experiments.begin(), experiments.end(), l.experiment) == experiments.end())
        experiment->add("bad_value", fmt::format("there is no experiment \"{}\"", l.experiment),
                        did_you_mean(l.experiment, experiments));
      effect_.look_alikes.push_back(std::move(l));
    }
  }

  /// "limit {limit}": each name in braces is a free number.
  void says(const JsonPlace& place) {
    const auto says = place.find("says");
    if (!says) return;
    content_.says = says->text().value_or("");
    std::vector<std::string> known;
    for (const auto& f : content_.free) known.push_back(f.path);
    for (auto open = content_.says.find('{'); open != std::string::npos; open = content_.says.find('{', open + 1)) {
      const auto close = content_.says.find('}', open);
      const std::string name = content_.says.substr(open + 1, close == std::string::npos ? close : close - open - 1);
      if (close == std::string::npos || std::find(known.begin(), known.end(), name) == known.end())
        says->add("unknown_parameter", fmt::format("\"{{{}}}\" is no free number of the effect", name),
                  did_you_mean(name, known));
    }
  }

  JsonFile file_;
  std::shared_ptr<const Diagram> diagram_;
  Effect effect_;
  Content content_;
};

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

Law law_of(const Content& c, const Excitation& at) {
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

std::string unseen(const Content& c, const Excitation& at) {
  const std::string wanted = c.diagram->inputs.find("in")->unit;
  if (!wanted.empty() && !at.unit.text.empty() &&
      dimension_factor(at.unit.dimension, parse_unit(wanted).dimension) == 0)
    return fmt::format("the wire is in {}, the effect acts on a signal in {}", at.unit.text, wanted);
  if (!at.from_data) return "";
  if (auto still = effects::stands_still(at); !still.empty()) return still;
  const Needs& n = c.needs;
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
    return fmt::format("{} train recordings, the effect needs {}", at.recordings, n.recordings);
  const double little = 1e-3 * at.range();  // rounding of a drive that ends at zero is no sign
  if (n.changes_sign && (at.lowest > -little || at.highest < little)) return "the signal does not change its sign";
  return "";
}

std::string summary(const Content& c, const Law& law, const std::vector<double>& values, const Excitation& at) {
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

/// The effect between an input and an output, as it would stand on a wire in the unit that it states.
ProgramPointer alone(const Effect& effect, Diagram diagram, const Registry& registry) {
  Excitation at;
  at.unit = parse_unit(diagram.inputs.find("in")->unit);
  if (effect.side != Side::none) at.side_unit = parse_unit((diagram.inputs.end() - 1)->second.unit);
  const Node block = effect.laws(at).front().block;
  for (const auto& [name, value] : block.parameters) diagram.parameters[name].value = value;
  auto program = compile(diagram, registry);
  const auto& out = program->signals[static_cast<std::size_t>(program->output_signals.front())].unit;
  if (dimension_factor(out.dimension, at.unit.dimension) == 0)
    fail("wrong_unit", "/outputs/out",
         fmt::format("the effect hands on a signal in {}, what came in was in {}", to_text(out.dimension),
                     to_text(at.unit.dimension)),
         "an effect keeps the unit of its wire; where its numbers have units, state that of the wire: \"inputs\": "
         "{\"in\": {\"unit\": \"V\"}}");
  return program;
}

/// Finds the free numbers in the compiled effect; what the engine says of it is told with the lines of the file.
void find_in_program(const Effect& effect, Content& content, const Registry& registry) {
  try {
    const ProgramPointer program = alone(effect, *content.diagram, registry);
    for (auto& f : content.free) {
      f.program_path = f.path;
      if (program->find_parameter(f.path) == nullptr) f.program_path = element(f.path, 0);
      if (program->find_parameter(f.program_path) == nullptr)
        fail("unknown_parameter", "/effect/free/" + f.path, fmt::format("no block reads \"{}\"", f.path),
             fmt::format("write \"${}\" where a block needs it, or leave it out", f.path));
    }
  } catch (Error& e) {
    locate_problems(e, content.file);
    throw Error(e.fault, e.problems);
  }
}

}  // namespace

Effect read_effect(const std::string& file, const Registry& registry, const std::vector<std::string>& allowed) {
  auto diagram = std::make_shared<const Diagram>(read_diagram(file, allowed));
  EffectReader reader(file, diagram);
  Effect e = reader.read();
  e.way = Way::insert;
  e.block_type = "diagram";
  e.file = file;
  const auto content = std::make_shared<Content>(reader.content());
  e.laws = [content](const Excitation& at) { return std::vector<Law>{law_of(*content, at)}; };
  e.unseen = [content](const Excitation& at) { return unseen(*content, at); };
  if (!content->says.empty())
    e.summary = [content](const Law& law, const std::vector<double>& values, const Excitation& at) {
      return summary(*content, law, values, at);
    };
  find_in_program(e, *content, registry);
  const Wiring w(*diagram, registry);
  bool linear = e.side == Side::none;
  for (const auto& [name, node] : diagram->blocks) {
    e.is_memory = e.is_memory || w.has_memory(name);
    linear = linear && w.is_linear(name);
  }
  if (linear) e.commutes = Commutes::linear;
  return e;
}

Effects with_own_effects(const Effects& library, const std::vector<std::string>& files, const Registry& registry,
                         const std::vector<std::string>& allowed) {
  namespace fs = std::filesystem;
  std::vector<std::string> all;
  for (const auto& given : files) {
    std::error_code code;
    if (!fs::is_directory(given, code)) {
      all.push_back(given);
      continue;
    }
    std::vector<std::string> inside;
    for (const auto& entry : fs::directory_iterator(given, code))
      if (entry.path().extension() == ".json") inside.push_back(entry.path().string());
    if (inside.empty())
      fail("no_file", given, "the folder holds no effect file", "name a folder with *.json, or one file");
    std::sort(inside.begin(), inside.end());
    all.insert(all.end(), inside.begin(), inside.end());
  }
  std::vector<Effect> list = library.list();
  for (const auto& file : all) {
    Effect e = read_effect(file, registry, allowed);
    for (const auto& other : list)
      if (other.id == e.id)
        fail("effect_twice", file,
             fmt::format("there is an effect \"{}\" already{}", e.id, other.file.empty() ? "" : ", in " + other.file),
             "give it another id");
    list.push_back(std::move(e));
  }
  Effects effects(std::move(list));
  for (const auto& e : effects.list())
    for (const auto& l : e.look_alikes)
      if (!e.file.empty() && effects.find(l.effect) == nullptr)
        fail("unknown_effect", e.file,
             fmt::format("\"{}\" names the look-alike \"{}\", and there is no such effect", e.id, l.effect),
             did_you_mean(l.effect, effects.ids()));
  return effects;
}

}  // namespace hysteron
