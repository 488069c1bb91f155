// Decides what one block is to the reference: outputs from inputs and memory, rates of states, branches whose changes
// are located, and instants that are known beforehand. Nothing of the program is included: the laws are written again
// from the equations of their pages.
#pragma once

#include <limits>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace reference {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr double same_instant = 1e-11;  ///< instants nearer than this are one [s]

/// A block of a flat diagram: nested diagrams opened, choices made, numbers in SI.
struct Block {
  std::string name, type;
  std::vector<std::pair<std::string, std::string>> in{};  ///< port ("" by position), signal
  std::map<std::string, std::vector<double>> numbers{};
  std::map<std::string, std::string> texts{};
  std::vector<double> instants{}, samples{};  ///< of a recorded signal

  double number(const std::string& key) const;
  double number(const std::string& key, double otherwise) const;
  const std::vector<double>& list(const std::string& key) const;
  std::string text(const std::string& key, const std::string& otherwise) const;
};

/// The reference does not know what is asked of it; the diagram counts as not tried.
struct Unknown : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Where the diagram is: time, all signals, all states. `free`: at an instant, where outputs may jump; between instants
/// what switches stays as it was.
struct Point {
  double t = 0;
  const double* s = nullptr;
  const double* x = nullptr;
  bool free = false;
};

class Law {
 public:
  virtual ~Law() = default;
  std::vector<int> in{};  ///< signals that it reads
  int out = 0, x = 0;     ///< its first signal and state

  virtual std::vector<std::string> inputs() const { return {"u"}; }
  virtual std::vector<std::string> outputs() const { return {"y"}; }
  virtual int states() const { return 0; }
  /// Does an output at an instant need an input at that instant?
  virtual bool direct() const { return true; }
  virtual void start(double* /*x*/) const {}
  /// Does it hand on what its input was earlier, at first what that had been for ever before the start: `rest`?
  virtual bool is_late() const { return false; }
  virtual void rest_at(double /*rest*/) {}
  virtual void output(const Point& p, double* y) const = 0;
  virtual void rates(const Point& /*p*/, double* /*dx*/) const {}
  /// What must not change within a step.
  virtual long branch(const Point& /*p*/) const { return 0; }
  /// The point is accepted: memory takes it in.
  virtual void keep(const Point& /*p*/) {}
  /// At an instant, behind `keep`: modes and states that jump. True if anything changed.
  virtual bool change(const Point& /*p*/, double* /*x*/) { return false; }
  /// The instant is over: everything has settled.
  virtual void leave(const Point& /*p*/) {}
  // How rough an instant is: 0 a jump, 1 a bend, each integration adds one. Dead times hand on what is rough.
  virtual int roughness() const { return 1; }               ///< of its output where it changes itself
  virtual int smooths() const { return direct() ? 0 : 1; }  ///< by how much its output is less rough than its inputs
  virtual void bends(int /*roughness*/) {}                  ///< its input does at this instant
  virtual double next() const { return never; }             ///< the next instant that is known beforehand [s]
  virtual void arrive(double /*t*/) {}                      ///< that instant is reached
  virtual double fastest() const { return never; }          ///< the shortest time in the law [s]: steps stay well below
  virtual double largest_step() const { return never; }

 protected:
  double u(const Point& p, std::size_t i = 0) const { return p.s[in[i]]; }
};

using LawPointer = std::unique_ptr<Law>;

/// What the forms of a PID controller come to: P and I see the error and `lead` times its filtered rate.
struct PidGains {
  double kp = 1, ki = 0, kd = 0, lead = 0;
  double filter = 1, tracking = 0;  ///< [s]  tracking 0: there is no integral
};
PidGains pid_gains(const Block& block);
std::vector<std::string> pid_inputs(bool tracks);

/// The law of a block. Throws Unknown.
LawPointer make_law(const Block& block);

// One per file of laws; null where the type is not among them.
LawPointer make_source(const Block& block);
LawPointer make_static(const Block& block);
LawPointer make_math(const Block& block);
LawPointer make_logic(const Block& block);
LawPointer make_hysteresis(const Block& block);
LawPointer make_linear(const Block& block);
LawPointer make_integral(const Block& block);
LawPointer make_body(const Block& block);
LawPointer make_drive(const Block& block);
LawPointer make_machine(const Block& block);
LawPointer make_sampled(const Block& block);

}  // namespace reference
