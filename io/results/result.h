// Decides what a verb leaves behind: result.json for programs, traces as tables, and the sections that report/ draws.
// A folder of results (result_folder.cpp) is written whole or not at all (staged_results.h).
#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "io/data/csv.h"
#include "io/files/folder_lock.h"

namespace hysteron {

class StagedResults;

/// One curve of a figure: two columns of a trace file, or numbers given here.
struct Curve {
  std::string name;   ///< "measured", "simulated", "residual 02.csv" ...
  std::string style;  ///< "line", "points", "steps"
  std::string role;   ///< "measured", "simulated", "residual", "before", "after", "" : the report's colours
  std::string trace, x_column, y_column;  ///< trace = file name in traces/
  std::vector<double> x, y;               ///< used where trace is empty
  std::string colour{};  ///< "time": runs through a scale from the first point to the last; "": by role
};

struct Bar {
  std::string label;
  double value = 0;
  std::string text;  ///< shown at the bar, e.g. "78 % (0.21 um)"
  std::string role;
};

struct Figure {
  std::string title, x_label, y_label;
  /// "curves", "bars" (each bar on its own), "waterfall" (the error falling step by step; role "floor" draws a line),
  /// "picture" (an SVG)
  std::string kind = "curves";
  std::vector<Curve> curves;
  std::vector<Bar> bars;
  std::string caption;
  bool log_x = false, log_y = false;
  std::string picture{};  ///< of kind "picture": its name among the document's files ("final.svg")
  /// Ends of the axes where they are given: two numbers, or none for what the curves need.
  std::vector<double> x_range{}, y_range{};
};

struct Table {
  std::string title;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

struct Section {
  std::string title;
  std::vector<std::string> text;  ///< paragraphs
  std::vector<Table> tables;
  std::vector<Figure> figures;
  std::string preformatted;  ///< a diff, a diagram
  std::string preformatted_title;
};

/// What one verb found. `facts` is verb-specific and stands in result.json beside the sections.
struct Document {
  std::string verb, title;
  std::string headline;                ///< the answer in one sentence
  std::string verdict;                 ///< "" or adequate, missing_effect, not_distinguishable, unexplained
  std::vector<std::string> sentences;  ///< what matters, most important first
  std::vector<std::string> warnings;   ///< what the reader must not overlook
  std::vector<Figure> answer{};        ///< what shows the headline, on the first screen: at most four
  std::vector<Section> sections;
  std::vector<CsvTable> traces;  ///< file = name in traces/ ("01.csv", "01.f64")
  /// Further files of the folder: name, content ("step1.json").
  std::vector<std::pair<std::string, std::string>> files;
  /// Files that were too large to be held here, and are written before the document: "study.h5".
  std::vector<std::string> data;
  std::shared_ptr<nlohmann::json> facts;  ///< may be null
};

/// result.json as text: format, $schema, verb, verdict, headline, facts, sections (figures by reference to traces).
std::string result_text(const Document& document);
bool is_result(std::string_view text);            ///< true if this is the text of a result.json of hysteron
Document read_result(const std::string& folder);  ///< from result.json and traces/

/// A name for traces/ made from a recording's name: "lab 2/02.csv (2)" -> "lab_2_02.csv__2_.csv".
std::string trace_file_name(const std::string& name);

/// A file name for a trace, from whatever a recording is called: "02.csv (2)" becomes "02-2.csv". Unique among `taken`.
/// `type` decides the form in which it is written (io/data/table_file.h).
std::string trace_file(const std::string& name, const std::vector<CsvTable>& taken, const std::string& type = ".csv");

/// Writes the folder: result.json with its schema, traces/, further files, and report.html (made by the caller
/// from the document); all of them or none. A folder that is there stays: what an earlier run of the same verb wrote is
/// replaced, and what others put there is not touched. Two at once take turns; `waiting` is told of the other. Throws
/// Error "cannot_write", "folder_in_use"; Stopped (engine/diagram/stop.h) before anything is replaced.
void write_result(const std::string& folder, const Document& document, const std::string& report_html,
                  const FolderLock::Waiting& waiting = {});

/// The same where the folder is locked, is known to be ours, and some of its new files (Document::data) were written
/// before.
void finish_result(StagedResults& staged, const std::string& folder, const Document& document,
                   const std::string& report_html);

}  // namespace hysteron
