#include "app/cli/options.h"

namespace hysteron::options {

OptionSpec diagram() { return {"diagram", "DIAGRAM.json", "the diagram file", true, false}; }
OptionSpec data(bool required) {
  return {"--data", "FILE", "the recordings: a data set (.json), or one recording (CSV ...)", required, false};
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
  return {"--allow", "FILE|FOLDER", "also read files of this folder; a file.fmu is run only if it is named so", false,
          true};
}
OptionSpec threads(const std::string& things) {
  return {"--threads", "N", things + " at once; default: one per core", false, false};
}
OptionSpec traces() { return {"--traces", "FORM", "csv (default) or f64, for millions of rows", false, false}; }
OptionSpec effects() {
  return {"--effects", "FILE", "effects of your own: an effect file (docs/adding-an-effect.md), or a folder of them",
          false, true};
}

}  // namespace hysteron::options
