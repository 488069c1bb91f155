// Decides what an instance of an exported diagram does in which phase, the same for both versions of the interface.
// Does not speak C: fmi2.cpp and fmi3.cpp do. What the binary brings along of other libraries: fmt_inside.cpp.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/simulate/stepped_simulation.h"
#include "io/fmi/fmi_variables.h"

namespace hysteron::interop {

class FmuInstance {
 public:
  enum class Phase { instantiated, initialization, stepping, terminated, failed };

  /// All that changes while it runs: a value.
  struct State {
    Phase phase = Phase::instantiated;
    std::map<int, double> parameters{};  ///< place in program.parameters -> what was set [SI]
    std::vector<double> inputs{};        ///< [SI]
    double begin = 0;                    ///< [s]
    std::optional<double> stop{}, tolerance{};
    std::unique_ptr<SteppedSimulation> stepper{};  ///< null until something of it is asked for

    State() = default;
    State(const State& other);
    State(State&&) = default;
    State& operator=(State&&) = default;
  };

  /// `resources`: the folder with program.json. Throws Error, where it is not that of this token too.
  FmuInstance(const std::string& resources, const std::string& token);

  void set_up(std::optional<double> tolerance, double begin, std::optional<double> stop);
  void enter_initialization();
  void exit_initialization();
  void terminate();
  void reset();
  /// In the unit of the variable.
  double get(unsigned reference);
  void set(unsigned reference, double value);
  /// From `from`, where it has to be, over `size` [s].
  void step(double from, double size);
  double t() const;  ///< [s]
  State saved() const { return state_; }
  void restore(const State& state) { state_ = State(state); }

 private:
  void need_phase(std::initializer_list<Phase> allowed, const char* what) const;
  const FmiVariable& variable(unsigned reference) const;
  void set_parameter_value(const FmiVariable& v, double si);
  SteppedSimulation& stepper();
  State fresh() const;

  ProgramPointer program_;
  std::vector<FmiVariable> variables_;
  State state_;
};

}  // namespace hysteron::interop
