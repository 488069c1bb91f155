// Decides in which other units a number is offered. Does not convert in diagrams: there it stays as it is written.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace hysteron::studio {

/// [{"text"}] of "1.2 V/um" in units of the same kind that engineers write, those that give few digits before and
/// behind the point first. Empty for a text that is no quantity.
nlohmann::ordered_json same_in_other_units(const std::string& quantity);

}  // namespace hysteron::studio
