// Decides how a verb gets its diagram, its program and its data from the files that the user named.
// Does not read files itself (io/), nor check them.
#include "app/cli/load.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "app/cli/block_words.h"
#include "blocks/register_all.h"
#include "discover/effects/all.h"
#include "discover/hypotheses/effect_file.h"
#include "engine/compile/draft.h"
#include "engine/diagram/error.h"
#include "engine/diagram/settings.h"
#include "engine/program/names.h"
#include "fit/inspect/inspection.h"
#include "io/diagram/diagram_file.h"

namespace hysteron {
namespace {

/// "path=value" of --set and --choose.
std::vector<Override> overrides(const Arguments& arguments, const std::string& option) {
  std::vector<Override> list;
  for (const auto& written : arguments.list(option)) {
    const auto equals = written.find('=');
    if (equals == 0 || equals == std::string::npos || equals + 1 == written.size())
      fail("bad_command_line", option, "\"" + written + "\" has no value behind a \"=\"",
           option == "--set" ? "write --set controller.kp=\"0.5 V/um\"" : "write --choose compensator=none");
    list.push_back({written.substr(0, equals), written.substr(equals + 1)});
  }
  return list;
}

}  // namespace

const Registry& registry() {
  static const Registry all = all_blocks();
  return all;
}

void with_lines_of(const Diagram& diagram, const std::function<void()>& action) {
  try {
    action();
  } catch (Error& error) {
    if (diagram.file.empty()) throw;
    locate_problems(error, diagram.file);
    throw Error(error.fault, error.problems);  // so that what() speaks of the lines too
  }
}

Diagram load_diagram(const Arguments& arguments, const Watch& watch) {
  Diagram diagram = read_diagram(arguments.text("diagram"), arguments.list("--allow"));
  apply_overrides(diagram, arguments, watch);
  return diagram;
}

void apply_overrides(Diagram& diagram, const Arguments& arguments, const Watch& watch) {
  const auto notes = settings_applied(diagram, overrides(arguments, "--set"), overrides(arguments, "--choose"));
  for (const auto& note : notes) watch.note(note);
}

namespace {

/// The engine knows no words from elsewhere: where a block type is missing the cure is told here.
void tell_other_names(Error& error) {
  for (auto& p : error.problems) {
    const auto open = p.what.find('"'), close = p.what.rfind('"');
    if (p.code == "unknown_block" && p.path.ends_with("/type") && close > open)
      p.cure = instead_of_type(p.what.substr(open + 1, close - open - 1));
  }
}

}  // namespace

namespace {

ProgramPointer compile_by(const Diagram& diagram, ProgramPointer (*compile_it)(const Diagram&)) {
  ProgramPointer program;
  with_lines_of(diagram, [&] {
    try {
      program = compile_it(diagram);
    } catch (Error& error) {
      tell_other_names(error);
      throw Error(error.fault, error.problems);
    }
  });
  return program;
}

}  // namespace

ProgramPointer compile_file(const Diagram& diagram) {
  return compile_by(diagram, [](const Diagram& d) { return compile(d, registry()); });
}

ProgramPointer compile_telling_all(const Diagram& diagram) {
  return compile_by(diagram, [](const Diagram& d) {
    DraftProgram draft = compile_draft(d, registry());
    draft.problems.insert(draft.problems.end(), draft.warnings.begin(), draft.warnings.end());
    if (!draft.problems.empty()) throw Error(Fault::input, draft.problems);
    return draft.program;
  });
}

DataSet load_data(const Arguments& arguments, const Program& program) {
  DataSet data = read_dataset(arguments.text("--data"), arguments.list("--allow"));
  check_binding(data, program);
  return data;
}

void need_moving_outputs(const DataSet& data, const Program& program) {
  Problems problems;
  for (const auto& name : program.output_names) {
    const auto& recordings = data.recordings;
    const auto measured = std::find_if(recordings.begin(), recordings.end(), [&](const Recording& r) {
      return r.role != Role::test && r.columns.contains(name);
    });
    if (measured == recordings.end() || moves(data, name)) continue;
    problems.add(
        "never_moves", data.file.empty() ? measured->name : data.file,
        fmt::format("{} never moves in {}", name,
                    recordings.size() > 1 && !data.single ? "any recording" : measured->name),
        "check that the sensor was connected and that this is the right column; remove the output from the diagram to go on without it");
  }
  problems.throw_if_any();
}

Effects load_effects(const Arguments& arguments) {
  return with_own_effects(all_effects(), arguments.list("--effects"), registry(), arguments.list("--allow"));
}

Run start_recording(const Program& program, const DataSet& data, const Recording& recording) {
  Run run = start(program);
  for (const auto& input : program.input_names) bind_input(program, run, input, input_series(data, recording, input));
  for (const auto& [path, value] : recording.initial_values)
    run.x[static_cast<std::size_t>(named_state(program, path))] = value;
  begin_modes(program, run);
  return run;
}

std::string stem_of(const std::string& file) { return std::filesystem::path(file).stem().string(); }

std::string result_folder(const Arguments& arguments, const std::string& verb) {
  return arguments.text("-o", stem_of(arguments.text("diagram")) + "." + verb);
}

std::string trace_type(const Arguments& arguments) {
  const std::string form = arguments.text("--traces", "csv");
  if (form != "csv" && form != "f64")
    fail("bad_command_line", "--traces", fmt::format("traces cannot be written as \"{}\"", form),
         "write csv (text), or f64 (numbers as memory holds them, for millions of rows)");
  return "." + form;
}

}  // namespace hysteron
