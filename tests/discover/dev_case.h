// Decides how a case of ../shared/hidden-effects/dev and the measured recordings become a diagram and a data set for
// tests. Reads task.json alone; what is hidden (case.json) is read by the test that checks the answer.
#pragma once

#include <string>

#include "engine/diagram/diagram.h"
#include "io/data/dataset.h"

namespace hysteron::testing {

struct Case {
  Diagram diagram;
  DataSet data;
  bool numbers_are_exact = false;  ///< of the diagram, as DiscoverOptions has it
};

bool shared_is_there();
std::string shared(const std::string& path);  ///< path below ../shared
Case dev_case(const std::string& id);         ///< "003"
double noise_floor(const std::string& id);    ///< [m] the answer's floor, for checks only
Case piezo_stack();                           ///< gain + offset, gain free
Case heater();                                ///< first-order plant with free gain, time constant and ambient
DataSet data_from_json(const std::string& name, const std::string& json);

}  // namespace hysteron::testing
