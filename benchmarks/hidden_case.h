// Decides how a case of hidden effects (a folder with task.json and recordings, layout: README of the set) becomes the
// user's diagram and a data set. Reads what the user knows, never the answer. Shared by the benchmark and the tests.
#pragma once

#include <string>
#include <vector>

#include "engine/diagram/diagram.h"
#include "io/data/dataset.h"

namespace hysteron {

/// Whether the data set says how noisy the sensor is, as the task does; few users' do.
enum class Noise { stated, unstated };

struct HiddenCase {
  std::string id;
  std::string base;                  ///< "B1" .. "B5"
  std::vector<std::string> outputs;  ///< headers as in the recordings: "y [um]"
  bool numbers_are_exact = true;     ///< "base_parameters_exact": false = some per cent off
  Diagram diagram;
  std::string data_text;                ///< of a data set file, recordings by their full paths
  std::vector<std::string> free_paths;  ///< numbers of the diagram that the user knows roughly ("base_parameters_free")
};

/// Throws Error "no_file", "bad_case".
HiddenCase read_hidden_case(const std::string& folder, Noise noise = Noise::stated);

/// The effects that may be offered for these cases.
const std::vector<std::string>& hidden_effect_names();

}  // namespace hysteron
