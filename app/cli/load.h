// Decides how a verb gets its diagram, its program and its data from the files that the user named.
// Does not read files itself (io/), nor check them.
#pragma once

#include <functional>
#include <string>

#include "app/cli/verb.h"
#include "app/cli/watch.h"
#include "discover/hypotheses/effect.h"
#include "engine/program/program.h"
#include "io/data/dataset.h"

namespace hysteron {

/// The block types of this program.
const Registry& registry();

/// The diagram of the arguments, with --set and --choose applied.
Diagram load_diagram(const Arguments& arguments, const Watch& watch);
/// Applies --set and --choose; notes what the user should know of it.
void apply_overrides(Diagram& diagram, const Arguments& arguments, const Watch& watch);

/// Runs `action`; an Error that it throws gets the file and line of the diagram.
void with_lines_of(const Diagram& diagram, const std::function<void()>& action);

/// Compiles; problems get the file and line of the diagram.
ProgramPointer compile_file(const Diagram& diagram);
/// The same; what is thrown are the problems of all stages, not of the first that fails.
ProgramPointer compile_telling_all(const Diagram& diagram);

/// The data set of the arguments, bound to the program.
DataSet load_data(const Arguments& arguments, const Program& program);

/// Throws where an output of the program was measured but never moves: nothing can be fitted to it or judged by it.
void need_moving_outputs(const DataSet& data, const Program& program);

/// The library of effects and the user's own ones (--effects).
Effects load_effects(const Arguments& arguments);

/// A run at its start with the inputs of one recording bound.
Run start_recording(const Program& program, const DataSet& data, const Recording& recording);

/// "stage" of "diagrams/stage.json".
std::string stem_of(const std::string& file);

/// The type of the files in traces/ that options::traces() asks for: ".csv" or ".f64". Throws Error "bad_command_line".
std::string trace_type(const Arguments& arguments);

/// "-o", or "stage.compare" for stage.json and compare.
std::string result_folder(const Arguments& arguments, const std::string& verb);

}  // namespace hysteron
