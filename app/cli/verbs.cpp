// Decides which verbs there are, and what the options mean that several of them take.
// Does not parse the command line.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "app/cli/verb.h"
#include "engine/diagram/error.h"
#include "engine/diagram/number_text.h"
#include "engine/diagram/units.h"

namespace hysteron {

// Each stands in app/verbs, in a file of its name.
Verb new_verb();
Verb run_verb();
Verb check_verb();
Verb explain_verb();
Verb draw_verb();
Verb linearize_verb();
Verb inspect_verb();
Verb compare_verb();
Verb diagnose_verb();
Verb add_verb();
Verb remove_verb();
Verb fit_verb();
Verb discover_verb();
Verb study_verb();
Verb reproduce_verb();
Verb blocks_verb();
Verb effects_verb();
Verb schema_verb();

std::vector<Verb> all_verbs() {
  return {new_verb(),      run_verb(),     check_verb(),     explain_verb(), draw_verb(),    linearize_verb(),
          inspect_verb(),  compare_verb(), diagnose_verb(),  add_verb(),     remove_verb(),  fit_verb(),
          discover_verb(), study_verb(),   reproduce_verb(), blocks_verb(),  effects_verb(), schema_verb()};
}

std::string Arguments::text(const std::string& name, const std::string& otherwise) const {
  const auto found = given_.find(name);
  return found == given_.end() || found->second.empty() ? otherwise : found->second.back();
}

std::vector<std::string> Arguments::list(const std::string& name) const {
  const auto found = given_.find(name);
  return found == given_.end() ? std::vector<std::string>{} : found->second;
}

double Arguments::number(const std::string& name, double otherwise) const {
  if (!has(name)) return otherwise;
  const std::string written = text(name);
  const auto value = number_of(written);
  if (!value || !std::isfinite(*value))
    fail("bad_command_line", name, "\"" + written + "\" is no number", "write it as in " + name + "=4");
  return *value;
}

int Arguments::whole_number(const std::string& name, int otherwise, int most) const {
  const double value = number(name, otherwise);
  if (value < 1 || value > most || value != static_cast<int>(value))
    fail("bad_command_line", name, fmt::format("\"{}\" is no whole number from 1 to {}", text(name), most),
         fmt::format("write it as in {}=4", name));
  return static_cast<int>(value);
}

int Arguments::threads() const {
  return whole_number("--threads", std::max(1, static_cast<int>(std::thread::hardware_concurrency())));
}

double Arguments::seconds(const std::string& name, double otherwise) const {
  if (!has(name)) return otherwise;
  const std::string written = text(name);
  double value = 0;
  std::string unit;
  const std::string cure = fmt::format("write a time such as {0}=\"5 ms\" or {0}=\"2 min\"", name);
  if (!split_quantity(written, value, unit) || !std::isfinite(value))
    fail("bad_command_line", name, "\"" + written + "\" is no time", cure);
  if (unit.empty()) return value;
  const Unit read = parse_unit(unit, name);
  if (!(read.dimension == parse_unit("s").dimension))
    fail("bad_command_line", name, "\"" + written + "\" is no time", cure);
  return read.to_si(value);
}

namespace options {

OptionSpec diagram() { return {"diagram", "DIAGRAM.json", "the diagram file", true, false}; }
OptionSpec data(bool required) {
  return {"--data", "FILE", "the recordings: a data set (.json), or one recording (.csv)", required, false};
}
OptionSpec output_folder() {
  return {"-o", "FOLDER", "where the results go; default: named after the diagram and the verb, e.g. stage.compare",
          false, false};
}
OptionSpec output_file() { return {"-o", "FILE.json", "the diagram file to write", false, false}; }
OptionSpec set() {
  return {"--set", "PATH=VALUE", "use another value for one parameter, e.g. controller.kp=\"0.5 V/um\"", false, true};
}
OptionSpec choose() {
  return {"--choose", "BLOCK=NAME", "use another candidate of a choice, e.g. compensator=none", false, true};
}
OptionSpec allow() {
  return {"--allow", "FOLDER", "also read files of this folder (else only those inside the project)", false, true};
}
OptionSpec threads(const std::string& things) {
  return {"--threads", "N", things + " at once; default: one per core", false, false};
}
OptionSpec effects() {
  return {"--effects", "FILE", "effects of your own: an effect file (docs/adding-an-effect.md), or a folder of them",
          false, true};
}

}  // namespace options
}  // namespace hysteron
