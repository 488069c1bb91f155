// A small laboratory for tests: recordings made by formulas, and diagrams built without files.
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "blocks/register_all.h"
#include "engine/diagram/diagram.h"
#include "engine/program/program.h"
#include "fit/model/model.h"
#include "io/data/dataset.h"

namespace hysteron::lab {

using Signal = std::function<double(double)>;

inline const Registry& registry() {
  static const Registry r = all_blocks();
  return r;
}

/// Normal deviates that are the same on every machine (the standard distributions are not).
class Noise {
 public:
  explicit Noise(unsigned seed) : engine_(seed) {}
  double operator()() {
    const double u = uniform(), v = uniform();
    return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);
  }
  double uniform() { return (static_cast<double>(engine_() >> 11) + 0.5) / 9007199254740992.0; }

 private:
  std::mt19937_64 engine_;
};

inline Recording recording(const std::string& name, Role role, double step, std::size_t rows, const Signal& u) {
  Recording r;
  r.name = r.file = name;
  r.role = role;
  for (std::size_t i = 0; i < rows; ++i) {
    r.t.push_back(step * static_cast<double>(i));
    r.columns["u"].push_back(u(r.t.back()));
  }
  r.columns["y"].assign(rows, 0.0);
  r.units["u"] = parse_unit("V");
  r.units["y"] = parse_unit("um");
  r.first = 0;
  r.last = rows;
  return r;
}

/// One to fit to and one to judge, u = 3 - 3 cos of 1 and 1.7 Hz [V].
inline DataSet swings(double step, std::size_t rows) {
  DataSet data;
  data.notes["u"].to = "u";
  data.notes["y"].to = "y";
  for (const double f : {1.0, 1.7})
    data.recordings.push_back(recording(f < 1.5 ? "train" : "validate", f < 1.5 ? Role::train : Role::validate, step,
                                        rows,
                                        [f](double t) { return 3 - 3 * std::cos(2 * std::numbers::pi * f * t); }));
  return data;
}

/// A diagram with input u [V] and output y, blocks to be added.
inline Diagram diagram(const std::string& output) {
  Diagram d;
  d.inputs["u"].unit = "V";
  d.outputs["y"] = output;
  return d;
}

inline Node& add(Diagram& d, const std::string& name, const std::string& type, const std::string& in) {
  Node& n = d.blocks[name];
  n.type = type;
  n.in = {{"", in}};
  return n;
}

/// Replaces column y of every recording by what `program` says, plus white noise [SI].
inline void measure(DataSet& data, const ProgramPointer& program, double noise, unsigned seed,
                    const std::vector<ParameterValue>& values = {}) {
  auto copy = std::make_shared<DataSet>(data);
  for (auto& r : copy->recordings) {
    r.first = 0;
    r.last = r.t.size();
  }
  DataModel model(program, copy);
  std::vector<int> all;
  for (int r = 0; r < model.n_recordings(); ++r) all.push_back(r);
  const auto prediction = model.predict(values, all);
  Noise random(seed);
  for (std::size_t r = 0; r < data.recordings.size(); ++r) {
    auto& y = data.recordings[r].columns["y"];
    for (std::size_t i = 0; i < y.size(); ++i) y[i] = prediction.y[r][0][i] + noise * random();
  }
}

inline std::shared_ptr<const DataSet> shared(const DataSet& data) { return std::make_shared<DataSet>(data); }

}  // namespace hysteron::lab
