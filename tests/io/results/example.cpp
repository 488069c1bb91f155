#include "tests/io/results/example.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

namespace hysteron::example {
namespace {

CsvColumn column(const char* name, const char* unit) { return {name, {unit, {}, 1, 0}, {}}; }

/// A decaying sine through gain and a play operator; "noise" that needs no random numbers.
CsvTable trace() {
  CsvTable t;
  t.file = "02.csv";
  t.columns = {column("t", "s"), column("u", "V"), column("y", "um"), column("simulated", "um"),
               column("residual", "um")};
  double play = 0;
  for (std::size_t i = 0; i < rows; ++i) {
    const double time = 1e-3 * static_cast<double>(i);
    const double u = 30 + 30 * std::exp(-time / 20) * std::sin(2 * std::numbers::pi * 0.5 * time);
    play = std::max(u - 6, std::min(u + 6, play));
    double y = 0.1 * u + 0.03 * play + 0.02 * std::sin(1e4 * static_cast<double>(i * i % 9973));
    if (i == spike_row) y += 3;
    const double simulated = 0.13 * u;
    const double values[] = {time, u, y, simulated, y - simulated};
    for (std::size_t k = 0; k < 5; ++k) t.columns[k].values.push_back(values[k]);
  }
  return t;
}

Curve from_trace(const char* name, const char* role, const char* x, const char* y) {
  return {name, "line", role, "02.csv", x, y, {}, {}};
}

Section fall_of_the_error() {
  Section s;
  s.title = "How the error falls";
  s.text = {"On recordings not used for the fit.", "A paragraph with `code` and <i>markup</i> & more."};
  s.tables = {{"Candidates",
               {"effect", "place", "fall of chi2", "why"},
               {{"hysteresis", "drive", "12 345", "the largest fall on recordings that were not used for the fit"},
                {"creep", "drive", "-3", "no fall"}}}};
  Figure waterfall;
  waterfall.title = "RMS error on validation recordings";
  waterfall.kind = "waterfall";
  waterfall.y_label = "rms error [um]";
  waterfall.bars = {{"base model", 0.42, "0.42 um", ""},
                    {"+ calibration", 0.36, "0.36 um", ""},
                    {"+ hysteresis at drive", 0.061, "0.061 um", ""},
                    {"+ creep behind drive_hysteresis", 0.031, "0.031 um", ""},
                    {"noise floor", 0.021, "0.021 um", "floor"}};
  s.figures = {waterfall};
  return s;
}

Section one_recording() {
  Section s;
  s.title = "Recording 02.csv";
  Figure time{"Measured and simulated", "time [s]", "displacement [um]", "curves", {}, {}, "validate", false, false};
  time.curves = {from_trace("measured", "measured", "t", "y"), from_trace("simulated", "simulated", "t", "simulated")};
  Figure residual = time;
  residual.title = "Residual";
  residual.y_label = "residual [um]";
  residual.curves = {from_trace("residual", "residual", "t", "residual")};
  Figure level{"Residual against level",
               "",
               "",
               "curves",
               {from_trace("residual", "residual", "u", "residual")},
               {},
               "",
               false,
               false};
  Figure rate{"Residual against rate", "rate of u [V/s]", "residual [um]", "curves", {}, {}, "", false, false};
  rate.curves = {{"mean", "points", "residual", "", "", "", {-90, -30, 30, 90}, {-0.3, -0.2, 0.2, 0.3}}};
  Figure bars{"Shares of the squared error by branch", "", "", "bars", {}, {}, "", false, false};
  bars.bars = {{"falling", 78, "78 %", ""}, {"rising", 20, "20 %", "residual"}, {"hold", 2, "2 %", ""}};
  s.figures = {time, residual, level, rate, bars};
  return s;
}

Section others() {
  Section s;
  s.title = "Title </script><script>document.body.dataset.owned='yes'</script>";
  Figure spectrum{"Spectrum", "frequency [Hz]", "amplitude [um]", "curves", {}, {}, "", true, true};
  Curve curve{"</script><img src=x onerror=alert(1)>", "line", "before", "", "", "", {}, {}};
  for (int i = 0; i <= 100; ++i) {
    curve.x.push_back(0.1 * std::pow(10.0, 0.04 * i));
    curve.y.push_back(0.2 / (1 + curve.x.back()));
  }
  spectrum.curves = {curve};
  Figure steps{"Heater", "time [s]", "power [W]", "curves", {}, {}, "", false, false};
  const double gap = std::numeric_limits<double>::quiet_NaN();
  steps.curves = {{"heater 1", "steps", "", "", "", "", {0, 1, 2, 3}, {0, 1e-6, gap, 2e-6}},
                  {"heater 2", "steps", "", "", "", "", {0, 1, 2, 3}, {1e-6, 0, 0, 0}}};
  Figure empty{"Nothing measured", "time [s]", "y [um]", "curves", {}, {}, "", false, false};
  s.figures = {spectrum, steps, empty};
  s.preformatted_title = "What changes";
  s.preformatted = " {\n-  \"stage\": {\"in\": \"drive\"}\n+  \"stage\": {\"in\": \"drive_hysteresis\"}\n }\n";
  return s;
}

}  // namespace

Document discovery() {
  Document d;
  d.verb = "discover";
  d.title = "Piezo stage <3>";
  d.headline =
      "`hysteresis` is missing before the stage: the error on other recordings falls from 0.42 um to 0.031 um.";
  d.verdict = "missing_effect";
  d.sentences = {"78 % of the squared error lies on falling branches.",
                 "It is no lag: the residual does not change with frequency."};
  d.warnings = {"y is one sample late; the data set does not say so."};
  d.sections = {fall_of_the_error(), one_recording(), others()};
  d.traces = {trace()};
  d.files = {{"step1.json", "{\"format\": 1}\n"}, {"steps/2.json", "{}\n"}};
  d.facts = std::make_shared<nlohmann::json>(nlohmann::json{{"rms_after", 0.031}, {"unit", "um"}});
  return d;
}

}  // namespace hysteron::example
