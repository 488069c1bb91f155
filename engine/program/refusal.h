// Decides how a block's refusal of its parameters reads: with the numbers and units of the file. Does not know why a
// block refuses (block.h).
#pragma once

#include <string>

#include "engine/program/program.h"

namespace hysteron {

/// The text of a block with its marks filled in: "{upper}" becomes the value of that parameter, "{0.002 in upper}" that
/// number [SI] in the unit of the parameter, both as the file has it: "5 mN".
std::string refusal_text(const Program& program, const Run& run, int block, const std::string& text);

}  // namespace hysteron
