#include "io/formats/mat_value.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "engine/diagram/error.h"
#include "io/formats/named_vectors.h"

namespace hysteron {
namespace {

class MatRecording {
 public:
  MatRecording(const std::string& file, const ReadingChoices& choices) : choices_(choices) { table_.file = file; }

  MeasuredTable of(const MatVariables& variables) {
    for (const auto& [name, value] : variables) variable(value, name, 0);
    if (vectors_.empty() && !objects_.empty()) refuse_objects();
    if (variables.empty())
      throw Error(Fault::input,
                  {{"damaged_file", table_.file, "this MAT file cannot be read: it is damaged, or not complete",
                    "save it again", table_.file, 0}});
    table_.assumed.insert(table_.assumed.begin(), "a MAT file");
    if (!objects_.empty()) table_.assumed.push_back(fmt::format("left out: {}, an object of MATLAB", objects_.front()));
    if (interval_ && *interval_ > 0) table_.clock = SampleClock{start_.value_or(0), *interval_};
    return table_of_vectors(std::move(table_), std::move(vectors_), choices_);
  }

 private:
  [[noreturn]] void refuse_objects() const {
    const std::string& name = objects_.front();
    throw Error(
        Fault::input,
        {{"unknown_file_type", name,
          fmt::format("\"{}\" is an object of MATLAB (a timeseries, a table ...), which only MATLAB reads", name),
          fmt::format(
              "save plain vectors there: for a timeseries t = {0}.Time; y = {0}.Data; save('lab.mat', 't', 'y'); for a "
              "table writetable({0}, 'lab.csv')",
              name),
          table_.file, 0}});
  }

  void variable(const MatValue& v, const std::string& name, int depth) {
    if (depth > deepest_of_mat) return;
    if (v.kind == MatValue::Kind::structure) structure(v, name, depth);
    if (v.kind == MatValue::Kind::object && !name.empty()) objects_.push_back(name);
    if (v.kind == MatValue::Kind::numbers) numbers(v, name, "");
  }

  void numbers(const MatValue& v, const std::string& name, const std::string& unit) {
    if (v.values.size() < 2) {
      if (v.values.size() == 1) setting(name, v.values.front());
      return;
    }
    // n x m samples of m channels; a row is a column, and what is wider than long holds a channel in each row. Simulink
    // stands samples behind each other: 1 x 1 x n.
    std::size_t rows = v.sizes[0], columns = v.values.size() / std::max<std::size_t>(rows, 1);
    const bool in_rows = columns > rows;
    if (in_rows) std::swap(rows, columns);
    if (v.sizes.size() > 2 && columns > 1) return;
    if (in_rows && columns > 1) table_.assumed.push_back(fmt::format("{}: each row is a channel", name));
    for (std::size_t c = 0; c < columns; ++c) {
      std::vector<double> channel(rows);
      for (std::size_t k = 0; k < rows; ++k) channel[k] = v.values[in_rows ? k * columns + c : c * rows + k];
      vectors_.push_back({columns == 1 ? name : fmt::format("{}_{}", name, c + 1), unit, std::move(channel)});
    }
  }

  /// Scalars by which PicoScope and others say when the samples stand.
  void setting(const std::string& name, double value) {
    if (name == "Tinterval" || name == "dt" || name == "Ts") interval_ = value;
    if (name == "Tstart" || name == "t0") start_ = value;
    if ((name == "fs" || name == "Fs") && value > 0) interval_ = 1 / value;
  }

  /// nullptr where there is none.
  static const MatValue* field(const MatValue& v, std::string_view name, std::size_t element) {
    for (const auto& f : v.fields)
      if (f.name == name && element < f.of_element.size()) return &f.of_element[element];
    return nullptr;
  }
  static std::string text_of(const MatValue* v) { return v == nullptr ? "" : v->text; }

  void structure(const MatValue& v, const std::string& name, int depth) {
    for (std::size_t e = 0; e < v.elements; ++e) {
      if (channel(v, name, e)) continue;
      for (const auto& f : v.fields) {
        if (e >= f.of_element.size()) continue;
        const std::string full = fmt::format("{}{}/{}", name, v.elements > 1 ? fmt::format("_{}", e + 1) : "", f.name);
        variable(f.of_element[e], f.name == "signals" || is_axis(f.name) ? name : full, depth + 1);
      }
    }
  }

  /// Fields that only group channels, by dSPACE: X, Y.
  static bool is_axis(std::string_view name) { return name == "X" || name == "Y"; }

  /// One channel: signals(k) of Simulink (values, label), X(k) and Y(k) of dSPACE (Data, Name, Unit).
  bool channel(const MatValue& v, const std::string& group, std::size_t element) {
    const MatValue *values = field(v, "values", element), *data = field(v, "Data", element);
    const MatValue* samples = values != nullptr ? values : data;
    if (samples == nullptr || samples->kind == MatValue::Kind::structure) return false;
    std::string label = text_of(field(v, values != nullptr ? "label" : "Name", element));
    std::replace(label.begin(), label.end(), '/', '.');
    if (label.empty()) label = values == nullptr && element == 0 ? "time" : fmt::format("signal_{}", element + 1);
    if (samples->kind == MatValue::Kind::numbers)
      numbers(*samples, fmt::format("{}/{}", group, label), text_of(field(v, "Unit", element)));
    return true;
  }

  const ReadingChoices& choices_;
  MeasuredTable table_;
  std::vector<MeasuredColumn> vectors_;
  std::vector<std::string> objects_;
  std::optional<double> interval_, start_;
};

}  // namespace

MeasuredTable recording_of_mat(const std::string& file, const MatVariables& variables, const ReadingChoices& choices) {
  return MatRecording(file, choices).of(variables);
}

}  // namespace hysteron
