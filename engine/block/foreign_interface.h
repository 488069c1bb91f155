// Decides how a block whose law is a program of somebody else is told what that program takes and gives: as one text,
// which stands in a parameter of the block. Does not read such programs (io/fmi) nor run them (blocks/fmi).
#pragma once

#include <string>
#include <vector>

namespace hysteron {

struct ForeignVariable {
  std::string port;  ///< as diagrams write it
  unsigned reference = 0;
  std::string unit{};            ///< SI, as parse_unit() reads it; "" = none
  double scale = 1, offset = 0;  ///< SI value = scale * its number + offset
};

struct ForeignInterface {
  std::string file{};                 ///< as the diagram writes it, for messages
  int version = 2;                    ///< of the Functional Mock-up Interface
  std::string token{};                ///< by which its binary knows it
  std::string binary{}, resources{};  ///< where they lie unpacked; "": it may not be run
  std::vector<ForeignVariable> inputs{}, outputs{}, parameters{};
};

std::string foreign_interface_text(const ForeignInterface& interface);

/// What foreign_interface_text() wrote. Throws Error "bad_value" at "/interface".
ForeignInterface foreign_interface(const std::string& text);

}  // namespace hysteron
