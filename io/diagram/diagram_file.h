// Decides how a diagram stands in a JSON file (diagram_read.cpp; its JSON Schema: diagram_schema.cpp,
// effect_schema.cpp), how it is written back so that a diff shows only what changed (diagram_write.cpp), and on which
// line of the file a problem stands (locate.cpp).
#pragma once

#include <string>
#include <vector>

#include "engine/block/kernel.h"
#include "engine/diagram/diagram.h"
#include "engine/diagram/error.h"

namespace hysteron {

/// Reads a diagram with everything that it names (nested diagrams, parameter sets, recorded inputs).
/// Throws Error with file, line and JSON path for syntax, unknown keys, wrong types, a newer format, paths outside the
/// project.
Diagram read_diagram(const std::string& file, const std::vector<std::string>& allowed = {});

/// Does a diagram stand in this file, and nothing more (an effect file is a diagram with what it means besides)? Told
/// by its keys: what is in them may be wrong. False where it is no JSON.
bool is_diagram_file(const std::string& file);

/// The text of a diagram file: keys in the order of docs/diagrams.md, one block per line where it fits.
std::string diagram_text(const Diagram& diagram);

/// The diagram as it stands at another place: `$schema` and relative paths seen from the folder of `file`.
Diagram moved_diagram(const Diagram& diagram, const std::string& file);

/// Writes a diagram whole or not at all. `$schema` and relative paths are adapted to the place of `file`.
void write_diagram(const std::string& file, const Diagram& diagram);

/// Gives the problems of an Error the file and line of the diagram (their JSON pointers, or the names that begin block
/// paths, looked up in the text; "other.json#/blocks/a" in that file). What is located already, or stands on the
/// command line, stays.
void locate_problems(Error& error, const std::string& file);

/// JSON Schemas, written from the declarations.
std::string diagram_schema(const Registry& registry);
/// Of an effect file: a diagram and what it means where it is put on a wire (discover/hypotheses/effect_file.h).
std::string effect_schema(const Registry& registry);

}  // namespace hysteron
