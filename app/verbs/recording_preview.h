// Decides how the verb new reads a recording and its columns as its command line says, and what of that is still open.
// Does not guess roles (column_roles.h) and writes nothing.
#pragma once

#include "app/cli/arguments.h"
#include "app/verbs/column_roles.h"
#include "io/formats/measured_table.h"
#include "studio/own_verbs.h"

namespace hysteron {

using studio::RecordingPreview;

/// What the command line says of a file that leaves something open. Throws Error "bad_command_line".
ReadingChoices reading_choices(const Arguments& arguments);

/// Roles that the command line gives. Throws as StarterRoles::add().
StarterRoles given_roles(const Arguments& arguments, const CsvTable& table);

/// The first recording of a command line of the verb new, what is assumed of it, and what is open, as questions.
/// Throws Error "bad_command_line".
RecordingPreview preview_recording(const Arguments& arguments);

}  // namespace hysteron
