// Decides the blocks "mass_spring_damper", "mass_on_stiffening_spring" and "mass_with_drag". Does not decide their law:
// models/mechanics/mass_spring_damper.h.
#pragma once

#include <optional>

#include "blocks/mechanics/motion_words.h"
#include "engine/block/block.h"
#include "models/mechanics/mass_motion.h"
#include "models/mechanics/mass_spring_damper.h"

namespace hysteron::blocks {

template <class T>
struct ForceIn {
  T force;
};
template <class T>
struct MotionState {
  T position, velocity;
};
template <class T>
struct MotionOut {
  T position, velocity;
};

/// An exact step that is made anew where a row is not as long as the one before.
struct RowStep {
  std::optional<mass_motion::ExactStep> step;
  double h = 0;  ///< [s]
  const mass_motion::ExactStep& of(const mass_spring_damper::Params<double>& law, double length);
};

/// What holds a mass besides a linear spring and damper: what a spring holds more, and the drag of a fluid.
class BeyondLinear {
 public:
  explicit BeyondLinear(const mass_spring_damper::Params<double>& law) : law_(law) {}
  bool is_none() const;
  double spring(double place) const { return law_.stiffness * place - mass_spring_damper::spring(law_, place); }  // [N]
  double drag(double velocity) const { return -mass_spring_damper::drag(law_.drag, velocity); }                   // [N]
  double operator()(const mass_motion::Motion& m) const { return spring(m.position) + drag(m.velocity); }
  /// Behind a row of h [s] that began at `from` [m], in which the mass moves evenly.
  mass_motion::Force behind_row(double from, double place, double h) const;
  /// How often mass_motion::step_under goes around.
  int rounds() const { return law_.drag != 0 ? 3 : 2; }

 private:
  mass_spring_damper::Params<double> law_;
};

/// What all blocks of one mass share: ports, states, outputs, start.
struct Mass {
  template <class T>
  using In = ForceIn<T>;
  template <class T>
  using State = MotionState<T>;
  template <class T>
  using Out = MotionOut<T>;
  template <class T, class Params>
  static MotionOut<T> output(const Params&, const MotionState<T>& s) {
    return {s.position, s.velocity};
  }
  template <class Params>
  static MotionState<double> initial(const Params& p) {
    return {p.initial_position, p.initial_velocity};
  }
};

struct MassSpringDamper : Mass {
  template <class T>
  struct Params {
    T mass, damping, stiffness, initial_position, initial_velocity;
  };
  static void describe(BlockSpec<MassSpringDamper>& spec);
  template <class T>
  static MotionState<T> derivative(const Params<T>& p, const MotionState<T>& s, const ForceIn<T>& in) {
    const mass_spring_damper::Params<T> law{p.mass, p.damping, p.stiffness, T{0}};
    return {s.velocity, mass_spring_damper::acceleration(law, s.position, s.velocity, in.force)};
  }
  static MotionState<double> rest(const Params<double>& p, const ForceIn<double>& in) {
    return {mass_spring_damper::rest({p.mass, p.damping, p.stiffness, 0}, in.force), 0};
  }
};

struct MassOnStiffeningSpring : Mass {
  template <class T>
  struct Params {
    T mass, damping, stiffness, stiffening, quadratic, quintic, drag, initial_position, initial_velocity;
  };
  static void describe(BlockSpec<MassOnStiffeningSpring>& spec);
  template <class T>
  static MotionState<T> derivative(const Params<T>& p, const MotionState<T>& s, const ForceIn<T>& in) {
    return {s.velocity, mass_spring_damper::acceleration(law(p), s.position, s.velocity, in.force)};
  }
  static MotionState<double> rest(const Params<double>& p, const ForceIn<double>& in) {
    return {mass_spring_damper::rest(law(p), in.force), 0};
  }
  /// The linear motion exactly; what holds the mass besides as a force on the motion: mass_motion::step_under, and in
  /// the longest rows step_to_balance.
  class OwnStep {
   public:
    explicit OwnStep(const Params<double>& p) : law_(law(p)), beyond_(law_) {}
    bool takes(double h) const { return mass_motion::has_exact_step(law_.mass, law_.damping, law_.stiffness, h); }
    MotionState<double> operator()(const MotionState<double>& s, const ForceIn<double>& from, const ForceIn<double>& to,
                                   double h);

   private:
    mass_spring_damper::Params<double> law_;
    BeyondLinear beyond_;
    RowStep row_, half_row_;
  };

 private:
  template <class T>
  static mass_spring_damper::Params<T> law(const Params<T>& p) {
    return {p.mass, p.damping, p.stiffness, p.stiffening, p.quadratic, p.quintic, p.drag};
  }
};

/// The drag of a body in a fluid grows with the square of its speed.
struct MassWithDrag : Mass {
  template <class T>
  struct Params {
    T mass, damping, stiffness, drag, initial_position, initial_velocity;
  };
  static void describe(BlockSpec<MassWithDrag>& spec);
  template <class T>
  static MotionState<T> derivative(const Params<T>& p, const MotionState<T>& s, const ForceIn<T>& in) {
    const mass_spring_damper::Params<T> law{p.mass, p.damping, p.stiffness, T{0}, T{0}, T{0}, p.drag};
    return {s.velocity, mass_spring_damper::acceleration(law, s.position, s.velocity, in.force)};
  }
  static MotionState<double> rest(const Params<double>& p, const ForceIn<double>& in) {
    return {mass_spring_damper::rest({p.mass, p.damping, p.stiffness, 0}, in.force), 0};
  }
};

/// Ports, the first two states, and mass, damping and stiffness, with which the Params of all bodies begin. Returns the
/// stiffness.
ParameterDeclaration& describe_motion(Declaration& d, const MotionWords& words = translation);
/// Position and velocity at the start, with which they end.
void describe_start(Declaration& d, const MotionWords& words = translation);
/// What a block whose mass remembers may have besides, 0 where nothing is said: stiffening, quadratic, quintic, drag.
/// They stand behind the start; bent_law() reads them. Says how both vary the block, which keeps its type.
void describe_beyond_linear(Declaration& d, const MotionWords& words = translation);
/// Its number, which is none where nothing is said.
ParameterDeclaration& describe_drag(Declaration& d, const MotionWords& words = translation);

/// The mass of a sized block, on its linear spring with what describe_beyond_linear() gives it.
template <class Block, class T>
mass_spring_damper::Params<T> bent_law(const View<T>& v) {
  return {v.parameter(Block::mass),       v.parameter(Block::damping),   v.parameter(Block::stiffness),
          v.parameter(Block::stiffening), v.parameter(Block::quadratic), v.parameter(Block::quintic),
          v.parameter(Block::drag)};
}

Kernel mass_spring_damper_block();
Kernel mass_on_stiffening_spring_block();
Kernel mass_with_drag_block();

}  // namespace hysteron::blocks
