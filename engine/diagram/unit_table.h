// Decides how units come from a machine that has udunits2's table to one that has not: those that were read there are
// learnt here. Besides lets a test read a unit from the whole of that table, where parse_unit() would know it without.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "engine/diagram/units.h"

namespace hysteron {

/// Scale 0 if the text is no unit.
Unit parse_unit_in_full_table(std::string_view text);

/// Symbols and prefixes that are known without the table.
std::vector<std::string> common_unit_symbols();
std::vector<std::string> common_unit_prefixes();

/// While it lives, it collects the units that parse_unit() gives and that stand in the whole table alone, of all
/// threads.
class UnitLog {
 public:
  UnitLog();
  ~UnitLog();
  UnitLog(const UnitLog&) = delete;
  UnitLog& operator=(const UnitLog&) = delete;
  std::vector<Unit> units() const;  ///< by their texts

 private:
  std::map<std::string, Unit> found_;
};

/// From now on parse_unit() knows these without the table.
void learn_units(const std::vector<Unit>& units);

}  // namespace hysteron
