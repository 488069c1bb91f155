#include "discover/hypotheses/effect_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "engine/diagram/error.h"
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

class EffectReader {
 public:
  EffectReader(const std::string& file, std::shared_ptr<const Diagram> diagram) : file_(file), diagram_(diagram) {
    content_.file = file;
    content_.diagram = std::move(diagram);
  }

  EffectAsWritten read() {
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
    return {std::move(effect_), std::move(content_)};
  }

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
    EffectFreeNumber f;
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

  void read_scan(const JsonPlace& place, EffectFreeNumber& f) const {
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
  static void check_order(const JsonPlace& place, const EffectFreeNumber& f) {
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
    EffectNeeds& n = content_.needs;
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
  EffectContent content_;
};

}  // namespace

EffectAsWritten read_effect_member(const std::string& file, std::shared_ptr<const Diagram> diagram) {
  return EffectReader(file, std::move(diagram)).read();
}

}  // namespace hysteron
