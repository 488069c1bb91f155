#include "io/jobs/runs_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "io/files/project_path.h"
#include "io/jobs/job_parts.h"
#include "io/jobs/runs_names.h"
#include "io/jobs/runs_parts.h"
#include "io/json/json_reader.h"
#include "io/json/value_text.h"

namespace hysteron {
namespace {

using namespace job_parts;

class RunsReader {
 public:
  RunsReader(const std::string& file, const std::vector<std::string>& allowed, bool full)
      : file_(file), paths_(file, allowed), full_(full) {}

  RunsJob read() {
    const JsonPlace root = file_.root();
    if (!root.expect_object("{\"format\": 1, \"do\": \"runs\", \"diagram\": \"stage.json\", \"runs\": {...}}"))
      file_.throw_if_any();
    check_format(root, "job");
    root.only({"$schema", "format", "do",  "title", "source", "remark", "surrogate", "assumed", "shows",  "learnt",
               "diagram", "choose", "set", "until", "every",  "draw",   "runs",      "plots",   "values", "claims"});
    head(root);
    if (const auto runs = root.find("runs"); runs && runs->expect_object("{\"none\": {\"choose\": {...}}}"))
      for (const auto& [name, place] : runs->members()) run(name, place);
    if (const auto plots = root.find("plots"); plots && plots->expect_array("[{\"y\": {\"signal\": \"stage\"}}]"))
      for (const auto& place : plots->elements())
        if (auto wish = plot_of(place)) job_.plots.push_back(*std::move(wish));
    if (const auto values = root.find("values"); values && values->expect_object("{\"stroke\": {\"take\": ...}}"))
      for (const auto& [name, place] : values->members())
        if (check_name(place, name, "value")) job_.values.push_back(value_of(name, place, true));
    if (const auto claims = root.find("claims"); claims && claims->expect_array("[{\"id\": \"C2-07\", ...}]"))
      for (const auto& place : claims->elements())
        if (auto part = claim_of(place)) job_.claims.push_back(*std::move(part));
    check_names(file_, job_);
    file_.throw_if_any();
    check_circles(file_, job_);
    file_.throw_if_any();
    return std::move(job_);
  }

 private:
  void head(const JsonPlace& root) {
    job_.file = file_.file();
    job_.name = std::filesystem::path(job_.file).stem().string();
    text_member(root, "$schema");
    job_.title = text_member(root, "title");
    job_.source = text_member(root, "source");
    job_.remark = text_member(root, "remark");
    job_.surrogate = text_member(root, "surrogate");
    job_.assumed = text_member(root, "assumed");
    job_.shows = text_member(root, "shows");
    job_.learnt = text_member(root, "learnt");
    default_.file = path(root, "diagram");
    settings(root, default_);
    default_.until = number_of(root, "until");
    default_.every = number_of(root, "every");
    if (const auto draw = root.find("draw"); draw && draw->expect_object("{\"The loop\": \"loop.json\"}"))
      for (const auto& [caption, place] : draw->members())
        if (const auto written = place.text()) job_.draw.emplace_back(caption, resolved(place, *written));
  }

  std::string resolved(const JsonPlace& place, const std::string& written) {
    if (const auto found = paths_.resolve(file_.file(), written)) return *found;
    place.add("outside_project", fmt::format("\"{}\" lies outside the project {}", written, paths_.project()),
              outside_cure(written));
    return "";
  }
  std::string path(const JsonPlace& object, const char* key) {
    const auto place = object.find(key);
    const auto written = place ? place->text() : std::nullopt;
    return written ? resolved(*place, *written) : "";
  }

  /// "choose" and "set"; a value to be set may be one of the job's own: {"of": "bottom"}.
  static void settings(const JsonPlace& object, RunWish& run) {
    if (const auto choose = object.find("choose"); choose && choose->expect_object("{\"compensator\": \"none\"}"))
      for (const auto& [name, place] : choose->members())
        if (const auto text = place.text()) run.choose.push_back({name, *text});
    const auto set = object.find("set");
    if (!set || !set->expect_object("{\"controller.kp\": \"0.5 V/um\"}")) return;
    for (const auto& [name, place] : set->members()) {
      if (place.is_number()) {
        run.set.push_back({name, exact_number_text(*place.number())});
      } else if (place.is_object() && place.find("of")) {
        place.only({"of", "times"});
        run.set_of.push_back(
            {{name, place.pointer()}, text_at(*place.find("of")), number_member(place, "times").value_or(1)});
      } else if (const auto text = place.text()) {
        run.set.push_back({name, *text});
      }
    }
  }

  // ---- runs ---------------------------------------------------------------------------------------------------------

  void run(const std::string& name, const JsonPlace& place) {
    check_name(place, name, "run");
    if (!place.expect_object("{\"choose\": {\"compensator\": \"none\"}}")) return;
    const auto kind = kind_of(place);
    RunWish r;
    if (!place.find("diagram")) r = default_;
    r.name = name;
    r.pointer = place.pointer();
    r.title = text_member(place, "title");
    text_member(place, "remark");
    r.kind = kind;
    if (place.find("diagram")) r.file = path(place, "diagram");
    if (r.title.empty()) r.title = name;
    settings(place, r);
    if (const auto until = number_of(place, "until")) r.until = until;
    if (const auto every = number_of(place, "every")) r.every = every;
    use(place, r);
    if (kind == RunKind::linearize) linearize(place, r);
    if (kind == RunKind::fit) fit(place, r);
    if (kind == RunKind::find) find(place, r);
    if (kind == RunKind::minimize) minimize(place, r);
    if (kind == RunKind::study) study(place, r);
    if (kind == RunKind::select) {
      r.other_run = text_at(*place.find("select"));
      r.where = conditions_of(place);
    }
    if (kind == RunKind::table) r.file = path(place, "table");
    if (kind == RunKind::rows) rows(place, r);
    if (kind == RunKind::computed) computed(place, r);
    if (kind == RunKind::elsewhere) {
      r.file = path(place, "from");
      r.other_run = text_of(place, "run").value_or(WrittenText{name, place.pointer()});
    }
    if (r.file.empty() && simulates(kind))
      place.add("missing_key", "nothing says which diagram this run simulates",
                "write \"diagram\": \"stage.json\" here or at the top of the job");
    job_.runs.push_back(std::move(r));
  }

  static bool simulates(RunKind kind) {
    return kind == RunKind::simulate || kind == RunKind::linearize || kind == RunKind::fit || kind == RunKind::find ||
           kind == RunKind::minimize;
  }

  RunKind kind_of(const JsonPlace& place) {
    std::vector<std::string> known{"title", "remark"};
    const auto also = [&](std::initializer_list<const char*> keys) {
      known.insert(known.end(), keys.begin(), keys.end());
    };
    RunKind kind = RunKind::simulate;
    if (place.find("linearize")) {
      kind = RunKind::linearize;
      also({"linearize", "diagram", "choose", "set", "use"});
    } else if (place.find("fit")) {
      kind = RunKind::fit;
      also({"fit", "method", "data", "free", "choose", "set"});
    } else if (place.find("table")) {
      kind = RunKind::table;
      also({"table"});
    } else if (place.find("from")) {
      kind = RunKind::elsewhere;
      also({"from", "run"});
    } else if (place.find("study")) {
      kind = RunKind::study;
      also({"study", "draws", "accepted", "every", "step", "record", "full"});
    } else if (place.find("select")) {
      kind = RunKind::select;
      also({"select", "where"});
    } else if (place.find("minimize")) {
      kind = RunKind::minimize;
      also({"minimize", "diagram", "choose", "set", "use", "until", "every"});
    } else if (place.find("rows")) {
      kind = RunKind::rows;
      also({"rows"});
    } else if (place.find("computed")) {
      kind = RunKind::computed;
      also({"computed", "of", "top"});
    } else if (place.find("find")) {
      kind = RunKind::find;
      also({"find", "diagram", "choose", "set", "use", "until", "every"});
    } else {
      also({"diagram", "choose", "set", "use", "until", "every"});
    }
    place.only(known);
    return kind;
  }

  /// "use": "fitted", ["a", "b"], or {"fitted": "compensator"}.
  static void use(const JsonPlace& place, RunWish& r) {
    const auto at = place.find("use");
    if (!at) return;
    if (at->is_object()) {
      for (const auto& [name, prefix] : at->members())
        r.use.push_back({{name, prefix.pointer()}, prefix.text().value_or("")});
      return;
    }
    for (auto& name : texts_of(place, "use")) r.use.push_back({std::move(name), ""});
  }

  static void linearize(const JsonPlace& place, RunWish& r) {
    const JsonPlace at = *place.find("linearize");
    if (!at.expect_object("{\"from\": \"error\", \"to\": \"stage\", \"open\": \"error\"}")) return;
    at.only({"from", "to", "open", "at"});
    if (const auto from = at.need("from", "name the signal where the small motion enters")) r.from = text_at(*from);
    if (const auto to = at.need("to", "name the signal at which it is looked")) r.to = text_at(*to);
    r.open = texts_of(at, "open");
    r.at = number_of(at, "at");
  }

  void fit(const JsonPlace& place, RunWish& r) {
    r.file = path(place, "fit");
    r.choose.clear();
    r.set.clear();
    r.set_of.clear();
    settings(place, r);
    r.method = text_of(place, "method");
    for (const auto& name : texts_of(place, "free")) r.free.push_back(name.text);
    const auto data = place.find("data");
    if (!data || !data->expect_object("{\"run\": \"loop\", \"columns\": {\"u\": \"drive\", \"y\": \"stage\"}}")) return;
    data->only({"run", "columns", "between", "rezero"});
    FitDataWish wish;
    if (const auto run = data->need("run", "name the run whose rows are fitted")) wish.run = text_at(*run);
    if (const auto columns = data->need("columns", "say which signal is which input or output");
        columns && columns->expect_object("{\"u\": \"drive\", \"y\": \"stage\"}"))
      for (const auto& [name, signal] : columns->members()) wish.columns.emplace_back(name, text_at(signal));
    wish.between = window_of(*data);
    for (const auto& name : texts_of(*data, "rezero")) wish.rezero.push_back(name.text);
    r.data = std::move(wish);
  }

  void find(const JsonPlace& place, RunWish& r) {
    const JsonPlace at = *place.find("find");
    if (!at.expect_object("{\"parameter\": \"a.b\", \"range\": [1, 2], \"value\": {...}, \"equals\": \"0 V\"}")) return;
    at.only({"parameter", "range", "value", "equals"});
    if (const auto name = at.need("parameter", "name what is varied: \"drive.amplitude\""))
      r.parameter = text_at(*name);
    if (const auto range = at.need("range", "give two values between which it lies");
        range && range->expect_array("[\"1 um\", \"2 um\"]"))
      for (const auto& end : range->elements())
        if (const auto number = read_number(end)) r.range.push_back({*number, end.pointer()});
    if (r.range.size() != 2) at.add("bad_value", "a range has two ends", "write \"range\": [\"1 um\", \"2 um\"]");
    if (const auto aim = at.need("value", "say what is measured: {\"take\": \"stroke\", \"of\": \"stage\"}"))
      r.aim = value_of("", *aim, false);
    if (at.need("equals", "say what it shall be: \"6 um\""))
      if (const auto number = number_of(at, "equals")) r.equals = *number;
  }

  /// A number of which there are more with --full: {"seeds": 30, "full": {"seeds": 300}}.
  std::optional<double> size_of(const JsonPlace& object, const char* key) const {
    const auto full = object.find("full");
    if (full && full_ && full->find(key)) return number_member(*full, key);
    return number_member(object, key);
  }

  void study(const JsonPlace& place, RunWish& r) {
    r.file = path(place, "study");
    r.record = texts_of(place, "record");
    const auto full = place.find("full");
    if (full && full->expect_object("{\"accepted\": 2000000}")) full->only({"draws", "accepted", "every", "step"});
    const JsonPlace& object = full && full_ ? *full : place;
    const auto whole = [&](const char* key) -> std::optional<std::uint64_t> {
      const auto at = object.find(key);
      const auto value = at ? whole_at(*at, 1, 1e13) : std::nullopt;
      return value ? std::optional(static_cast<std::uint64_t>(*value)) : std::nullopt;
    };
    r.size = StudySize{whole("draws"), whole("accepted")};
    r.every = number_of(object, "every");
    r.step = number_of(object, "step");
    if (r.size->draws && r.size->accepted)
      object.add("bad_value", "two things say how many samples there are", "write \"draws\" or \"accepted\"");
  }

  void minimize(const JsonPlace& place, RunWish& r) {
    const JsonPlace at = *place.find("minimize");
    if (!at.expect_object("{\"value\": {...}, \"parameters\": {\"model.k\": [\"0.1 V\", \"10 V\"]}}")) return;
    at.only({"value", "parameters", "method", "runs", "seeds", "attractor", "full"});
    if (const auto full = at.find("full"); full && full->expect_object("{\"seeds\": 300}"))
      full->only({"seeds", "runs"});
    SearchWish search;
    if (const auto aim = at.need("value", "say what shall be small: {\"take\": \"sum_squares\", \"of\": \"y\", ...}"))
      r.aim = value_of("", *aim, false);
    if (const auto list = at.need("parameters", "name them with their ranges: {\"model.k\": [\"0.1 V\", \"10 V\"]}");
        list && list->expect_object("{\"model.k\": [\"0.1 V\", \"10 V\"]}"))
      for (const auto& [name, range] : list->members()) parameter_range(name, range, search);
    if (const auto method = text_of(at, "method")) search.method = *method;
    search.runs = std::lround(std::clamp(size_of(at, "runs").value_or(505), 1.0, 1e9));
    search.seeds = static_cast<int>(std::clamp(size_of(at, "seeds").value_or(1), 1.0, 1e5));
    if (const auto attractor = at.find("attractor");
        attractor && attractor->expect_object("{\"c\": \"model.c\", ...}")) {
      attractor->only({"c", "k", "top"});
      AttractorWish wish;
      wish.c = text_of(*attractor, "c").value_or(WrittenText{"", attractor->pointer()});
      wish.k = text_of(*attractor, "k").value_or(WrittenText{"", attractor->pointer()});
      if (attractor->need("top", "say how large the input gets: \"6 V\""))
        if (const auto top = number_of(*attractor, "top")) wish.top = *top;
      search.attractor = std::move(wish);
    }
    r.search = std::move(search);
  }
  static void parameter_range(const std::string& name, const JsonPlace& range, SearchWish& search) {
    if (!range.expect_array("[\"0.1 V\", \"10 V\"]")) return;
    const auto ends = range.elements();
    if (ends.size() != 2) {
      range.add("bad_value", "a range has two ends", "write [\"0.1 V\", \"10 V\"]");
      return;
    }
    const auto low = read_number(ends[0]), high = read_number(ends[1]);
    if (low && high)
      search.parameters.push_back({{name, range.pointer()}, {*low, ends[0].pointer()}, {*high, ends[1].pointer()}});
  }

  /// {"frequency": ["10 Hz", "20 Hz"], "added": ["added_10", "added_20"]}
  static void rows(const JsonPlace& place, RunWish& r) {
    const JsonPlace at = *place.find("rows");
    if (!at.expect_object("{\"frequency\": [\"10 Hz\", \"20 Hz\"], \"area\": [\"area_10\", \"area_20\"]}")) return;
    for (const auto& [name, list] : at.members()) {
      if (!check_name(list, name, "column") || !list.expect_array("[\"area_10\", \"area_20\"]")) continue;
      RowsColumn column{name, {}};
      for (const auto& cell : list.elements()) column.cells.push_back(cell_of(cell));
      if (!r.rows.empty() && r.rows.front().cells.size() != column.cells.size())
        list.add("bad_value",
                 fmt::format("{} rows here, {} in \"{}\"", column.cells.size(), r.rows.front().cells.size(),
                             r.rows.front().name),
                 "give every column as many");
      r.rows.push_back(std::move(column));
    }
    if (r.rows.empty() || r.rows.front().cells.empty())
      at.add("bad_value", "there are no rows", "name values of this job: {\"area\": [\"area_10\", \"area_20\"]}");
  }
  /// "10 Hz" and 10 are numbers; "area_10" is a value, whose name begins with a letter.
  static RowsColumn::Cell cell_of(const JsonPlace& place) {
    const auto text = place.is_text() ? place.text() : std::nullopt;
    if (text && !text->empty() && text->front() >= 'a' && text->front() <= 'z') return {text_at(place), {}};
    const auto number = read_number(place);
    return {{}, number ? std::optional(WrittenNumber{*number, place.pointer()}) : std::nullopt};
  }

  static void computed(const JsonPlace& place, RunWish& r) {
    r.formula = text_of(place, "computed").value_or(WrittenText{"", place.pointer()});
    if (std::find(computed_rows().begin(), computed_rows().end(), r.formula.text) == computed_rows().end())
      place.add("bad_value", fmt::format("there is no formula {}", json_quoted(r.formula.text)),
                did_you_mean(r.formula.text, computed_rows()));
    r.top = number_of(place, "top");
    const auto of = place.find("of");
    if (!of || !of->expect_object("{\"run\": \"near\", \"c\": \"model.c\", \"k\": \"model.k\"}")) return;
    of->need("run", "name the run whose rows are taken");
    for (const auto& [name, signal] : of->members())
      if (name == "run")
        r.of_run = text_at(signal);
      else
        r.of.emplace_back(name, text_at(signal));
  }

  JsonFile file_;
  ProjectPaths paths_;
  RunsJob job_;
  RunWish default_;
  bool full_;
};

}  // namespace

const std::vector<std::string>& takes() {
  static const std::vector<std::string> names{
      "at",           "first",       "last",      "min",         "max",       "stroke",    "mean",
      "rms",          "max_abs",     "area",      "remanence",   "overshoot", "settling",  "sum_squares",
      "rss_above",    "line_above",  "parameter", "cost",        "dc_gain",   "bandwidth", "crossover",
      "phase_margin", "gain_margin", "frequency", "damping",     "peak",      "deviation", "computed",
      "share",        "median",      "rows",      "ks_distance", "off_points"};
  return names;
}

const std::vector<std::string>& combinations() {
  static const std::vector<std::string> names{"ratio", "difference", "sum", "product", "largest", "smallest", "spread"};
  return names;
}

const std::vector<std::string>& computed_rows() {
  static const std::vector<std::string> names{"reflection", "piezo_lower", "piezo_upper", "piezo_band"};
  return names;
}

std::string what_a_job_does(const std::string& file) {
  JsonFile json(file);
  const auto root = json.root();
  if (!root.is_object()) return "";
  const auto what = root.find("do");
  return what && what->is_text() ? *what->text() : "";
}

RunsJob read_runs_job(const std::string& file, const std::vector<std::string>& allowed, bool full) {
  return RunsReader(file, allowed, full).read();
}

}  // namespace hysteron
