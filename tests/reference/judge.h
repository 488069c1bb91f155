// Decides whether the program agrees with the reference on one diagram: within ten tolerances of the size of each
// signal, with a jump no more than a hair of time away from where it belongs.
#pragma once

#include <string>

namespace reference {

enum class Verdict {
  agrees,
  refused,    ///< by the program, with a message
  wrong,      ///< the program and the reference differ
  undecided,  ///< the reference itself is not sure: not converged, or it hangs on a millionth of the sources
  unknown     ///< the reference does not know a law
};

const char* verdict_name(Verdict verdict);

struct Judgement {
  Verdict verdict = Verdict::agrees;
  std::string signal{};  ///< the worst one
  double error = 0;      ///< in tolerances of its size
  double t = 0;          ///< where [s]
  std::string words{};   ///< the message of a refusal
};

/// Runs both on the diagram in `file`, in this process.
Judgement judge(const std::string& file, double tolerance = 1e-6);

}  // namespace reference
