// Decides how a data set file, or a single CSV, becomes a DataSet: columns bound by name, roles, what is
// judged. Does not know the diagram: dataset_bind.cpp compares both.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "engine/diagram/error.h"
#include "io/data/binary_table.h"
#include "io/data/column_note.h"
#include "io/data/dataset.h"
#include "io/data/left_out_rows.h"
#include "io/data/recording_file.h"
#include "io/data/same_rows.h"
#include "io/files/atomic_file.h"
#include "io/files/project_path.h"
#include "io/formats/file_format.h"
#include "io/formats/instrument_unit.h"
#include "io/json/file_kind.h"
#include "io/json/json_reader.h"
#include "io/json/quantity.h"
#include "io/json/value_text.h"

namespace hysteron {
namespace {

constexpr double train_share = 0.6;     // of the time of a single recording
constexpr std::size_t fewest_rows = 3;  // judged rows of a recording: a standard deviation of two is chance

/// What the file says of one column. Noise is converted once the column's unit is known.
struct Noted {
  std::string column;
  JsonPlace place;
  ColumnNote note;
  bool unit_seen = false;
  std::vector<std::string> missing_in{};  ///< files, each once
  std::vector<std::string> known{};       ///< columns of the first of them
};

/// First row at or behind `time` since the first row; a row that misses it by rounding counts.
std::size_t row_at(const std::vector<double>& t, double time) {
  const double slack = 1e-6 * (t.back() - t.front()) / static_cast<double>(t.size() - 1);
  return static_cast<std::size_t>(std::lower_bound(t.begin(), t.end(), t.front() + time - slack) - t.begin());
}

/// Rows at which a delayed column shows a time before the recording are not judged.
void skip_unknown_past(Recording& recording, const std::map<std::string, ColumnNote>& notes) {
  for (const auto& [name, note] : notes) {
    if (!recording.columns.contains(name)) continue;
    recording.first = std::max(recording.first, static_cast<std::size_t>(note.delay_samples));
    if (note.delay_seconds > 0) recording.first = std::max(recording.first, row_at(recording.t, note.delay_seconds));
  }
}

/// "02.csv", "02.csv (2)", ...
std::string unique_name(const std::string& file, const std::vector<Recording>& before) {
  const auto taken = [&](const std::string& name) {
    return std::any_of(before.begin(), before.end(), [&](const Recording& r) { return r.name == name; });
  };
  std::string name = file;
  for (int i = 2; taken(name); ++i) name = fmt::format("{} ({})", file, i);
  return name;
}

std::string how_it_was_read(const std::string& file, const std::vector<std::string>& assumed) {
  return fmt::format("{} was read so: {}.", file, fmt::join(assumed, "; "));
}

/// One recording only: its first 60 % train, the rest validates, and the user is told.
void cut_single(DataSet& data) {
  data.single = true;
  cut_in_time(data, 0);
}

class DataSetReader {
 public:
  DataSetReader(const std::string& file, const std::vector<std::string>& allowed) : file_(file), paths_(file, allowed) {
    choices_.units_may_miss = true;
  }

  DataSet read() {
    const JsonPlace root = file_.root();
    if (!root.expect_object("{\"format\": 1, \"recordings\": [...]}")) file_.throw_if_any();
    check_kind(root, FileKind::data_set);
    check_format(root, "data set");
    root.only({"$schema", "format", "title", "source", "remark", "columns", "recordings"});
    text_member(root, "$schema");
    text_member(root, "source");
    text_member(root, "remark");
    data_.file = file_.file();
    data_.title = text_member(root, "title");
    if (const auto columns = root.find("columns"); columns && columns->expect_object("{\"y\": {\"to\": \"y\"}}"))
      for (const auto& [name, place] : columns->members()) column(name, place);
    recordings(root);
    for (const auto& noted : noted_) tell_where_it_is_missing(noted);
    file_.throw_if_any();
    for (auto& recording : data_.recordings) finish(recording);
    file_.throw_if_any();
    if (data_.recordings.size() == 1 && data_.recordings.front().role == Role::train) cut_single(data_);
    for (auto& warning : warnings_of_same_rows(data_)) data_.remarks.push_back(std::move(warning));
    return std::move(data_);
  }

 private:
  void column(const std::string& name, const JsonPlace& place) {
    if (!place.expect_object("{\"to\": \"y\", \"noise\": \"2 nm\"}")) return;
    place.only({"to", "unit", "between_samples", "noise", "zero", "delay", "optional", "limits", "remark"});
    text_member(place, "remark");
    Noted noted{name, place, {}};
    noted.note.to = place.find("to") ? text_member(place, "to") : name;
    if (name == "t" || noted.note.to == "t")
      return place.add("bad_value", "t is the time and cannot be bound", "take this entry out");
    if (const auto unit = place.find("unit")) read_unit(name, *unit);
    if (const auto choice = one_of(place, "between_samples", {"linear", "hold", "smooth"}))
      noted.note.between = between_of(*choice);
    if (const auto choice = one_of(place, "zero", {"shared", "per_recording"}))
      noted.note.zero_per_recording = *choice == "per_recording";
    if (const auto optional = place.find("optional")) noted.note.optional = optional->truth().value_or(false);
    if (const auto delay = place.find("delay")) read_delay(*delay, noted.note);
    if (data_.notes.contains(noted.note.to))
      return place.add("duplicate_column", fmt::format("two columns are bound to \"{}\"", noted.note.to),
                       "bind one of them to another name");
    data_.notes[noted.note.to] = noted.note;
    noted_.push_back(std::move(noted));
  }

  /// What stands in the file in its place; known before the files are read.
  void read_unit(const std::string& column, const JsonPlace& place) {
    const auto text = place.text();
    if (!text) return;
    const InstrumentUnit unit = instrument_unit(*text, column);
    if (unit.answer == UnitAnswer::known)
      choices_.units[column] = *text;
    else
      place.add(
          "bad_unit", unit.note.empty() ? fmt::format("{} is not a unit", json_quoted(*text)) : unit.note,
          unit.cure.empty() ? "write a unit such as \"um\", \"V\", \"rpm\", or \"1\" for a plain number" : unit.cure);
  }

  /// Once, however many files lack it.
  static void tell_where_it_is_missing(const Noted& noted) {
    const std::size_t n = noted.missing_in.size();
    if (n == 0) return;
    std::string where = noted.missing_in.front();
    if (n > 1) where += n == 2 ? " and " + noted.missing_in[1] : fmt::format(" and {} other files", n - 1);
    noted.place.add("missing_column",
                    fmt::format("{} {} no column \"{}\"", where, n > 1 ? "have" : "has", noted.column),
                    did_you_mean(noted.column, noted.known) + bracket_hint(noted.column, noted.known) +
                        (noted.unit_seen || n == 1 ? " If only some recordings have it: \"optional\": true" : ""));
  }

  std::optional<std::string> one_of(const JsonPlace& object, const char* key, const std::vector<std::string>& known) {
    const auto place = object.find(key);
    const auto text = place ? place->text() : std::nullopt;
    if (!text) return {};
    if (std::find(known.begin(), known.end(), *text) != known.end()) return text;
    place->add("bad_value", fmt::format("{} is not known here", json_quoted(*text)), did_you_mean(*text, known));
    return {};
  }

  void recordings(const JsonPlace& root) {
    const auto list = root.need("recordings", "write \"recordings\": [{\"file\": \"01.csv\", \"role\": \"train\"}]");
    if (!list || !list->expect_array("[{\"file\": \"01.csv\", \"role\": \"train\"}]")) return;
    const auto places = list->elements();
    if (places.empty())
      list->add("no_recordings", "there is no recording in the list",
                "list one: {\"file\": \"01.csv\", \"role\": \"train\"}");
    for (const auto& place : places)
      if (const auto file = place.is_object() ? place.find("file") : std::nullopt; file && file->is_text())
        ++listed_[path_of(*file)];
    for (const auto& place : places) recording(place, places.size() == 1);
  }

  /// "" where it lies outside the project.
  std::string path_of(const JsonPlace& file) const { return paths_.resolve(file_.file(), *file.text()).value_or(""); }

  void recording(const JsonPlace& place, bool alone) {
    if (!place.expect_object("{\"file\": \"01.csv\", \"role\": \"train\"}")) return;
    place.only({"file", "role", "start", "cycles_before", "initial", "skip", "until", "exclude", "weight", "remark"});
    Recording r;
    if (!alone) place.need("role", "write \"role\": \"train\", \"validate\" or \"test\"");
    if (const auto role = place.find("role")) read_role(*role, r);
    if (const auto start = place.find("start")) r.start_hours = in_hours(*start);
    r.cycles_before = number_member(place, "cycles_before");
    r.weight = number_member(place, "weight").value_or(1);
    if (!(r.weight > 0))
      place.find("weight")->add("bad_value", "a weight must be above 0", "take the recording out instead");
    r.remark = text_member(place, "remark");
    if (const auto initial = place.find("initial")) read_initial(*initial, r);
    const auto file = place.need("file", "write \"file\": \"01.csv\"");
    const auto written = file ? file->text() : std::nullopt;
    if (!written) return;
    auto* content = open(*file, *written);
    if (content == nullptr) return;
    const bool for_the_last_time = --listed_[path_of(*file)] == 0;
    r.name = unique_name(*written, data_.recordings);
    r.file = content->file;
    if (for_the_last_time)
      r.t = std::move(content->t);
    else
      r.t = content->t;
    bind(place, *content, r, for_the_last_time);
    note_use(r);
    read_span(place, r);
    read_excluded(place, r);
    data_.recordings.push_back(std::move(r));
  }

  void read_role(const JsonPlace& place, Recording& recording) {
    const auto role = place.text();
    if (!role) return;
    if (*role == "train")
      recording.role = Role::train;
    else if (*role == "validate")
      recording.role = Role::validate;
    else if (*role == "test")
      recording.role = Role::test;
    else
      place.add("unknown_role", fmt::format("there is no role {}", json_quoted(*role)),
                did_you_mean(*role, {"train", "validate", "test"}));
  }

  static std::optional<double> in_hours(const JsonPlace& place) {
    const Unit hour = parse_unit("h");
    const auto seconds = read_si(place, hour, QuantityKind::difference);
    return seconds ? std::optional(hour.difference_from_si(*seconds)) : std::nullopt;
  }

  void read_initial(const JsonPlace& place, Recording& recording) {
    recording.at_rest = false;
    recording.start_is_stated = true;
    if (place.is_object()) {
      for (const auto& [path, value] : place.members())
        if (const auto si = read_si_with_unit(value)) recording.initial_values[path] = *si;
      return;
    }
    if (!place.is_text()) return place.add_wrong_type("\"rest\", \"per_recording\" or values {\"stage.x\": \"1 um\"}");
    const auto text = *place.text();
    recording.at_rest = text == "rest";
    recording.initial_per_recording = text == "per_recording";
    if (!recording.at_rest && !recording.initial_per_recording)
      place.add("bad_value", fmt::format("{} is not known here", json_quoted(text)),
                did_you_mean(text, {"rest", "per_recording"}));
  }

  /// Reads each file once, however often it is listed. A file that cannot be read is told where it is named.
  RecordingFile* open(const JsonPlace& place, const std::string& written) {
    if (written.empty()) {
      place.add("bad_value", "the name of the file is empty", "write \"file\": \"01.csv\"");
      return nullptr;
    }
    const auto path = paths_.resolve(file_.file(), written);
    if (!path) {
      place.add("outside_project", fmt::format("\"{}\" lies outside the project {}", written, paths_.project()),
                outside_cure(written));
      return nullptr;
    }
    if (const auto known = files_.find(*path); known != files_.end()) return &known->second;
    try {
      auto& read = files_.emplace(*path, read_measured_recording(*path, fewest_rows, choices_)).first->second;
      if (!read.assumed.empty()) data_.remarks.push_back(how_it_was_read(written, read.assumed));
      return &read;
    } catch (const Error& error) {
      if (error.problems.front().file.empty())
        place.add(error.problems.front().code, error.problems.front().what, error.problems.front().cure);
      else
        file_.add(error);
      return nullptr;
    }
  }

  /// Takes the columns where no other recording is to have them.
  void bind(const JsonPlace& place, RecordingFile& content, Recording& recording, bool take) {
    for (auto& noted : noted_) {
      if (content.columns.contains(noted.column)) {
        if (!noted.unit_seen) {
          const Unit& unit = content.units.at(noted.column);
          ColumnNote& note = data_.notes.at(noted.note.to);
          if (const auto noise = noted.place.find("noise")) read_noise(*noise, unit, note.noise);
          if (const auto limits = noted.place.find("limits")) read_limits(*limits, unit, note);
        }
        noted.unit_seen = true;
      } else if (!noted.note.optional &&
                 std::find(noted.missing_in.begin(), noted.missing_in.end(), content.file) == noted.missing_in.end()) {
        if (noted.missing_in.empty()) noted.known = content.names;
        noted.missing_in.push_back(content.file);
      }
    }
    for (const auto& name : content.names) {
      const auto noted = std::find_if(noted_.begin(), noted_.end(), [&](const Noted& n) { return n.column == name; });
      const std::string& to = noted == noted_.end() ? name : noted->note.to;
      if (recording.columns.contains(to)) {
        place.add("duplicate_column", fmt::format("two columns of {} are called \"{}\"", content.file, to),
                  fmt::format("bind \"{0}\" to another name: \"columns\": {{\"{0}\": {{\"to\": \"{0}_2\"}}}}", name));
        continue;
      }
      auto& column = content.columns.at(name);
      if (take)
        recording.columns[to] = std::move(column);
      else
        recording.columns[to] = column;
      recording.units[to] = content.units.at(name);
      if (noted == noted_.end()) bound_by_name_.push_back(to);
    }
  }

  /// skip and until count from the first row, so that the same numbers cut a file into two parts wherever its clock
  /// begins.
  void read_span(const JsonPlace& place, Recording& recording) {
    const auto seconds = [&](const char* key) {
      const auto at = place.find(key);
      const auto value = at ? read_si(*at, parse_unit("s"), QuantityKind::difference) : std::nullopt;
      if (value && !(*value >= 0))
        at->add("bad_value", "a time since the start of the recording cannot be negative", "write 0 s or more");
      return value;
    };
    const auto skip = seconds("skip"), until = seconds("until");
    recording.first = skip ? row_at(recording.t, *skip) : 0;
    recording.last = until ? row_at(recording.t, *until) : recording.t.size();
    if (recording.last < recording.first + fewest_rows)
      place.add("too_few_rows",
                fmt::format("skip and until leave {} of {} to judge",
                            rows_text(recording.last > recording.first ? recording.last - recording.first : 0),
                            recording.t.size()),
                fmt::format("the recording is {} s long; skip less or go on longer",
                            exact_number_text(recording.t.back() - recording.t.front())));
  }

  /// [["2 s", "3.5 s"], ...], counted from the first row as skip and until are.
  void read_excluded(const JsonPlace& place, Recording& recording) {
    const auto list = place.find("exclude");
    constexpr char example[] = "[[\"2 s\", \"3.5 s\"]]";
    if (!list || !list->expect_array(example)) return;
    std::vector<ExcludedSpan> spans;
    for (const auto& entry : list->elements()) {
      if (!entry.expect_array("[\"2 s\", \"3.5 s\"]")) continue;
      const auto ends = entry.elements();
      if (ends.size() != 2) {
        entry.add("bad_value", "a span has a begin and an end", fmt::format("write {}", example));
        continue;
      }
      const auto from = read_si(ends[0], parse_unit("s"), QuantityKind::difference);
      const auto to = read_si(ends[1], parse_unit("s"), QuantityKind::difference);
      if (!from || !to) continue;
      if (!(*from >= 0) || !(*to > *from))
        entry.add("bad_value", "a span begins at 0 s or later and ends behind its begin",
                  fmt::format("write {}, counted from the first row", example));
      else
        spans.push_back({*from, *to});
    }
    leave_out_spans(recording, spans);
  }

  /// Every row has the value that the recording has.
  void note_use(Recording& recording) {
    const auto column = [&](const char* name, const std::optional<double>& value, const char* unit) {
      if (!value || recording.columns.contains(name)) return;
      const Unit read = parse_unit(unit);
      recording.columns[name].assign(recording.t.size(), read.to_si(*value));
      recording.units[name] = read;
      bound_by_name_.push_back(name);
    };
    column(column_of_cycles, recording.cycles_before, "");
    column(column_of_start, recording.start_hours, "h");
  }

  void finish(Recording& recording) {
    for (const auto& name : bound_by_name_)
      if (!data_.notes.contains(name)) data_.notes[name].to = name;
    skip_unknown_past(recording, data_.notes);
    for (auto& sentence : leave_out_clipped(recording, data_.notes)) data_.remarks.push_back(std::move(sentence));
    if (recording.last < recording.first + fewest_rows)
      file_.add("too_few_rows", "/recordings",
                fmt::format("the delays of the columns leave no row of {} to judge", recording.name),
                "shorten the delay, or record longer");
    else if (recording.count_judged() < fewest_rows)
      file_.add("too_few_rows", "/recordings",
                fmt::format("\"exclude\" and \"limits\" leave {} of {} to judge", rows_text(recording.count_judged()),
                            recording.name),
                "exclude less, widen the limits, or record longer");
  }

  JsonFile file_;
  ProjectPaths paths_;
  DataSet data_;
  std::vector<Noted> noted_;
  std::vector<std::string> bound_by_name_;
  std::map<std::string, RecordingFile> files_;
  std::map<std::string, int> listed_;  // how often each of them still is
  ReadingChoices choices_;
};

DataSet from_single_file(const std::string& file) {
  RecordingFile content = read_measured_recording(file, fewest_rows, {});
  DataSet data;
  data.file = file;
  data.title = std::filesystem::path(file).filename().string();
  Recording recording;
  recording.name = data.title;
  recording.file = file;
  recording.t = std::move(content.t);
  recording.last = recording.t.size();
  recording.columns = std::move(content.columns);
  recording.units = std::move(content.units);
  for (const auto& name : content.names) data.notes[name].to = name;
  data.recordings.push_back(std::move(recording));
  if (!content.assumed.empty()) data.remarks.push_back(how_it_was_read(data.title, content.assumed));
  cut_single(data);
  return data;
}

bool is_json(const std::string& file) {
  if (std::filesystem::path(file).extension() == ".json") return true;
  if (is_binary_table(file) || !is_text_file(file)) return false;  // the first begins with a line of JSON
  const std::string text = read_file(file);
  const auto begin = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  return begin != text.npos && text[begin] == '{';
}

}  // namespace

void cut_in_time(DataSet& data, std::size_t recording) {
  Recording& train = data.recordings[recording];
  const double begin = train.t[train.first], end = train.t[train.last - 1];
  const double cut = begin + train_share * (end - begin);
  const auto row = static_cast<std::size_t>(std::upper_bound(train.t.begin(), train.t.end(), cut) - train.t.begin());
  if (row < train.first + fewest_rows || train.last < row + fewest_rows)
    throw Error(
        Fault::input,
        {{"too_few_rows", train.name,
          fmt::format("the recording has {} to judge, too few to be cut into a part that trains and one that validates",
                      rows_text(train.last - train.first)),
          "record longer, or list a second recording", data.file, 0}});
  Recording validate = train;
  train.role = Role::train;
  validate.role = Role::validate;
  validate.name = unique_name(train.name, data.recordings);
  train.last = row;
  validate.first = row;
  const auto span = [](const Recording& r) {
    return fmt::format("{:.6g} s to {:.6g} s", r.t[r.first], r.t[r.last - 1]);
  };
  const auto note = [](Recording& r, const char* text) {
    r.remark += (r.remark.empty() ? "" : "; ") + std::string(text);
  };
  data.said_of_cut = fmt::format("{}, {}: the first 60 % of its time ({}) trains, the rest ({}) validates.",
                                 data.single ? "There is a single recording" : "A recording is cut in time", train.name,
                                 span(train), span(validate));
  data.remarks.push_back(data.said_of_cut);
  note(train, "first 60 % of the time");
  note(validate, "last 40 % of the time");
  data.recordings.push_back(std::move(validate));
}

std::string to_text(Role role) {
  switch (role) {
    case Role::train:
      return "train";
    case Role::validate:
      return "validate";
    case Role::test:
      return "test";
  }
  return "";
}

DataSet read_dataset(const std::string& file, const std::vector<std::string>& allowed) {
  return is_json(file) ? DataSetReader(file, allowed).read() : from_single_file(file);
}

}  // namespace hysteron
