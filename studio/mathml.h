// Decides how the law of a block, which its declaration writes as plain text ("dx/dt = (u - x)/time"), is set as a
// formula: MathML, which browsers draw by themselves. Words between formulas stay words.
#pragma once

#include <set>
#include <string>

namespace hysteron::studio {

/// "<math>...</math>", one for each clause of the law with "<br/>" between. `names`: of parameters and ports, which are one symbol also where they have several letters or
/// an underscore. Every text gives well-formed MathML; what does not read as a formula is set as it is written.
std::string mathml_of(const std::string& law, const std::set<std::string>& names);

}  // namespace hysteron::studio
