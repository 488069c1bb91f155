// Decides how a test calls one block without a diagram: parameters by name in SI, inputs, states and memory by hand.
// Does not check anything.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "engine/block/kernel.h"

namespace hysteron::bench {

using Numbers = std::vector<double>;
using Duals = std::vector<Dual>;

const Registry& registry();
/// Throws std::logic_error where there is no such block.
const Kernel& kernel_of(const std::string& type);

/// Values with their rates, all of them zero where none are given.
Duals dual(const Numbers& value, const Numbers& rate = {});
Numbers rates(const Duals& d);
/// a + h direction
Numbers moved(const Numbers& a, const Numbers& direction, double h);

/// One block with its numbers. Text parameters are given as the index of the choice, free texts as character codes, the
/// columns of a matrix "m" as "m columns". Blocks with vector ports get one wire, `inputs` elements long.
class Bench {
 public:
  using Values = std::map<std::string, Numbers>;

  Bench(const std::string& type, const Values& values, int inputs = -1);

  /// A default in SI ("10 us").
  static double default_of(const std::string& text);

  void prepare();
  std::string check() const;
  bool is_affine_in_modes() const;
  bool is_linear() const;  ///< in general, or with these parameters (Kernel::is_linear_at)

  /// Outputs for advanced memory `m`; the branch is the time where nothing else is said.
  Numbers output(double t, const Numbers& u = {}, const Numbers& x = {}, const Numbers& m = {}) const;
  Numbers output(double t, double branch, const Numbers& u, const Numbers& x, const Numbers& m) const;
  Duals output_rate(double t, double branch, const Duals& u, const Duals& x, const Duals& m) const;
  Numbers derivative(const Numbers& u, const Numbers& x, const Numbers& du = {}) const;
  Numbers advance(const Numbers& m, const Numbers& u) const;
  Duals advance_rate(const Duals& m, const Duals& u) const;
  /// Sampled states behind an instant.
  Numbers update(const Numbers& u, const Numbers& x) const;
  double guard(const Numbers& u, const Numbers& x = {}) const;
  /// Lets a mode whose guard is not positive change, with the states, until one may stay. Returns how many changed.
  int settle(const Numbers& u, Numbers& x);
  int initial_mode() const;
  Numbers rest(const Numbers& u) const;
  Numbers initial_states() const;
  Numbers initial_memory() const;
  double next_breakpoint(double t) const;
  double shortest_period() const;

  /// Output of a run by explicit Euler steps, memory committed after each, sampled blocks at every step: the response
  /// to inputs u[k] per wire.
  Numbers response(const std::vector<Numbers>& u, double step) const;
  Numbers walk(const std::vector<Numbers>& u, double step);

  /// Continuous or sampled states.
  int states() const { return sizes.states + sizes.sampled_states; }

  Kernel kernel;
  int mode = 0;  ///< of a block with modes
  long hit = 0;  ///< of a sampled block
  std::uint64_t key = 0;
  Shape shape;
  Sizes sizes;
  Numbers p, c;
  std::vector<int> p_at;
  int n_u = 0;  ///< input numbers
  const Series* series = nullptr;
  const History* history = nullptr;

 private:
  template <class T>
  View<T> view(const std::vector<T>& parameters, const std::vector<T>& u, const std::vector<T>& x,
               const std::vector<T>& m, T t, double branch) const;
  template <class T>
  static std::vector<T> call(void (*function)(const View<T>&), View<T> v, int count);
};

}  // namespace hysteron::bench
