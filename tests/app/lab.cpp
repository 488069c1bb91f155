// Decides the small laboratory of these tests: a diagram that works, recordings of a known law, and ways to spoil them.
#include "tests/app/lab.h"

#include <fmt/format.h>

#include <cmath>

namespace hysteron::lab {

std::string recording(int rows, double extra) {
  std::string text = "t [s],u [V],y [um]\n";
  for (int i = 0; i < rows; ++i) {
    const double phase = 0.02 * i - std::floor(0.02 * i);
    const double u = phase < 0.5 ? 4 * phase : 4 - 4 * phase;  // 0 .. 2 V, period 0.5 s
    text += fmt::format("{:.2f},{:.6f},{:.6f}\n", 0.01 * i, u, 1.5 * u + 0.2 + extra);
  }
  return text;
}

std::string diagram() {
  return R"({
  "format": 1,
  "title": "Stage",
  "parameters": {"gain": {"value": 1.5, "unit": "um/V", "bounds": [0, 10], "free": true}},
  "inputs": {"u": {"unit": "V"}},
  "blocks": {
    "actuator": {"type": "gain", "gain": "$gain", "in": "u"},
    "sensor":   {"type": "calibration", "gain": 1, "offset": "0.2 um", "in": "actuator"}
  },
  "outputs": {"y": "sensor"},
  "record": ["actuator", "sensor"]
}
)";
}

std::string dataset() {
  return R"({
  "format": 1, "title": "two recordings",
  "columns": {"u": {"to": "u"}, "y": {"to": "y", "noise": "1 nm"}},
  "recordings": [
    {"file": "a.csv", "role": "train"},
    {"file": "b.csv", "role": "validate"}
  ]
}
)";
}

void furnish(const process::Folder& folder) {
  folder.write("diagram.json", diagram());
  folder.write("dataset.json", dataset());
  folder.write("a.csv", recording());
  folder.write("b.csv", recording(150));
}

}  // namespace hysteron::lab
