#include "studio/import.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "engine/diagram/error.h"
#include "io/files/atomic_file.h"
#include "io/json/json_edit.h"
#include "io/json/problems_json.h"

namespace hysteron::studio {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Json = nlohmann::ordered_json;

constexpr std::size_t first_rows = 6, curve_points = 160;
const std::string aside = ".hysteron/dropped";

/// JSON has no NaN: what the file does not have is null.
Json number_json(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json raw_json(const MeasuredTable& table) {
  Json list = Json::array();
  for (const auto& column : table.columns) {
    Json values = Json::array();
    for (std::size_t i = 0; i < std::min(first_rows, column.values.size()); ++i)
      values.push_back(number_json(column.values[i]));
    list.push_back({{"name", column.name}, {"unit", column.unit}, {"values", values}});
  }
  return list;
}

/// Smallest and largest value of each of some stretches: a small picture of the column.
Json column_json(const CsvColumn& column) {
  const auto [low, high] = std::minmax_element(column.values.begin(), column.values.end());
  Json lows = Json::array(), highs = Json::array();
  const std::size_t rows = column.values.size(), stride = (rows + curve_points - 1) / curve_points;
  for (std::size_t row = 0; row < rows; row += std::max<std::size_t>(stride, 1)) {
    const auto begin = column.values.begin() + static_cast<long>(row);
    const auto [a, b] =
        std::minmax_element(begin, column.values.begin() + static_cast<long>(std::min(row + stride, rows)));
    lows.push_back(number_json(*a));
    highs.push_back(number_json(*b));
  }
  return {{"name", column.name},
          {"unit", column.unit.text},
          {"smallest", number_json(*low)},
          {"largest", number_json(*high)},
          {"low", lows},
          {"high", highs}};
}

/// Without a folder before it, and none of those names that mean something else.
std::string plain_name(const std::string& name) {
  const std::string last = fs::path(name).filename().string();
  const bool has_control =
      std::any_of(last.begin(), last.end(), [](char c) { return static_cast<unsigned char>(c) < 32; });
  if (last.empty() || last.front() == '.' || has_control)
    fail("bad_name", name, "a recording cannot be called so", "give the file a name that begins with no dot");
  return last;
}

void fill(const std::string& file, const std::string& bytes) {
  fs::create_directories(fs::path(file).parent_path());
  write_file(file, bytes);
}

}  // namespace

std::string Import::keep(const std::string& name, const std::string& bytes) const {
  const std::string kept = aside + "/" + plain_name(name);
  fill(folder_.file(kept), bytes);
  std::ofstream(folder_.path() + "/.hysteron/.gitignore") << "*\n";
  return kept;
}

Json Import::preview(const json& asked) const {
  const std::string name = asked.value("file", "");
  std::vector<std::string> words{new_.name, "--from=" + folder_.file(name), "-o", folder_.path()};
  const auto options = option_words(asked.value("options", json::object()), new_, folder_, WordPaths::absolute);
  words.insert(words.end(), options.begin(), options.end());
  const RecordingPreview found = own_.preview(words);
  Json told{{"file", name}, {"raw", raw_json(found.raw)}, {"raw_rows", found.raw.rows()}, {"columns", Json::array()}};
  if (const CsvColumn* time = found.table.find("t"); time != nullptr && !time->values.empty()) {
    for (const auto& column : found.table.columns) told["columns"].push_back(column_json(column));
    told["rows"] = found.table.rows();
    told["from"] = time->values.front();
    told["to"] = time->values.back();
    told["time_unit"] = time->unit.text;
  }
  told["as_it_stands"] = found.as_it_stands;
  told["assumed"] = found.assumed;
  told["inputs"] = found.inputs;
  told["outputs"] = found.outputs;
  told["questions"] = problem_list(found.questions);
  return told;
}

Json Import::carried_out(const std::vector<std::string>& files, const json& options, const std::string& target) const {
  std::vector<std::string> words{new_.name};
  for (const auto& file : files) words.push_back("--from=" + folder_.file(file));
  words.insert(words.end(), {"-o", target});
  const auto others = option_words(options, new_, folder_, WordPaths::absolute);
  words.insert(words.end(), others.begin(), others.end());
  Json answer = Json::parse(own_.carry_out(words, [] { return false; }).json);
  answer["words"] = words;
  return answer;
}

Json Import::start(const json& asked) const {
  const std::string target = asked.value("folder", "");
  const std::string place = target.empty() ? folder_.path() : folder_.file(target);
  Json answer =
      carried_out(asked.value("files", std::vector<std::string>{}), asked.value("options", json::object()), place);
  for (const char* what : {"diagram", "dataset"}) answer[what] = folder_.name_of(place + "/" + what + ".json");
  return answer;
}

Json Import::join(const json& asked) const {
  const std::string dataset = folder_.file(asked.value("dataset", ""));
  const std::string role = asked.value("role", "");
  if (role != "train" && role != "validate" && role != "test")
    fail("bad_request", "role", "a recording trains, validates or tests", "choose one of the three");
  const fs::path made = folder_.file(aside + "/.made");
  std::error_code error;
  fs::remove_all(made, error);
  carried_out({asked.value("file", "")}, asked.value("options", json::object()), made.string());
  std::string recording;
  for (const auto& entry : fs::directory_iterator(made)) {
    const std::string name = entry.path().filename().string();
    if (name != "diagram.json" && name != "dataset.json" && name != "hysteron.project") recording = name;
  }
  const std::string bytes = read_file((made / recording).string());
  fs::remove_all(made, error);
  const std::string beside = (fs::path(dataset).parent_path() / recording).string();
  if (fs::exists(beside, error) && read_file(beside) != bytes)
    fail("file_exists", recording, "another file of this name lies beside the data set",
         "give the recording another name, and drop it again");
  write_file(beside, bytes);
  const JsonEdit entry{JsonEdit::Kind::insert, "/recordings", "",
                       "{\"file\": " + json(recording).dump() + ", \"role\": " + json(role).dump() + "}", ""};
  write_file(dataset, edited_json(read_file(dataset), {entry}));
  return {{"recording", folder_.name_of(beside)}};
}

}  // namespace hysteron::studio
