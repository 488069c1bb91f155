// Decides the blocks "pid" and "pid_tracking", continuous, and what all PID controllers declare. Does not decide their
// law: models/continuous/pid.h.
#pragma once

#include <array>
#include <cmath>
#include <string>

#include "engine/block/block.h"
#include "models/continuous/pid.h"

namespace hysteron::blocks {

/// Form, gains, times, filter, limits: the parameters with which all PID controllers begin, in this order.
struct PidNumbers {
  double form, kp, ki, kd, integral_time, derivative_time, filter, derivative_on, setpoint_weight, lower, upper, rate;
};
void describe_pid(Declaration& d);
/// anti_windup, tracking_time, initial: behind what is the controller's own.
void describe_windup(Declaration& d, bool tracks);
/// The inputs, and what they are for.
void describe_pid_ports(Declaration& d, bool tracks);
/// "" or what is wrong with them, and the cure.
std::string check_pid(const PidNumbers& p, pid::AntiWindup windup, double tracking_time);

template <bool tracks>
struct Pid {
  enum Parameter {
    form,
    kp,
    ki,
    kd,
    integral_time,
    derivative_time,
    filter,
    derivative_on,
    setpoint_weight,
    lower,
    upper,
    rate,
    output_rate,
    follow_time,
    anti_windup,
    tracking_time,
    initial
  };
  enum Input { reference, measured, tracked };
  enum State { integral, filtered, command };  ///< command: only where its rate is limited

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  static std::string check(const View<double>& v);

  template <class T>
  static pid::Gains<T> gains(const View<T>& v) {
    return pid::gains(pid::Form(v.choice(form)), v.parameter(kp), v.parameter(ki), v.parameter(kd),
                      v.parameter(integral_time), v.parameter(derivative_time));
  }
  template <class T>
  static T differentiated(const View<T>& v) {
    return v.choice(derivative_on) == 0 ? T{-v.u[measured]} : T{v.u[reference] - v.u[measured]};
  }
  template <class T>
  static pid::Wanted<T> wanted(const View<T>& v) {
    const auto g = gains(v);
    const T d = (differentiated(v) - v.x[filtered]) / pid::filter_of(g, v.parameter(filter));
    return pid::wanted(g, v.parameter(setpoint_weight), v.u[reference], v.u[measured], d, v.x[integral]);
  }
  template <class T>
  static bool has_command(const View<T>& v) {
    return v.choice(output_rate) == 1;
  }
  template <class T>
  static T limited(const View<T>& v, const T& raw) {
    return pid::limited(v.parameter(lower), v.parameter(upper), raw);
  }
  /// How fast the command would go without a limit of its rate.
  template <class T>
  static T asked(const View<T>& v, const T& raw) {
    return (limited(v, raw) - v.x[command]) / v.parameter(follow_time);
  }
  template <class T>
  static void output(const View<T>& v) {
    v.out[0] = has_command(v) ? v.x[command] : limited(v, wanted(v).command);
  }
  template <class T>
  static void derivative(const View<T>& v) {
    const auto w = wanted(v);
    const T given = tracks ? v.u[tracked] : has_command(v) ? v.x[command] : limited(v, w.command);
    const auto g = gains(v);
    v.out[integral] = pid::integral_rate(pid::AntiWindup(v.choice(anti_windup)), w, given,
                                         pid::tracking_time_of(g, v.parameter(tracking_time)), v.parameter(lower),
                                         v.parameter(upper));
    v.out[filtered] = (differentiated(v) - v.x[filtered]) / pid::filter_of(g, v.parameter(filter));
    if (has_command(v)) v.out[command] = pid::limited(T{-v.parameter(rate)}, v.parameter(rate), asked(v, w.command));
  }
  /// Without limits: back_calculation has nothing to do then, and clamping is refused.
  static bool is_linear_at(const View<double>& v) {
    return std::isinf(v.parameter(lower)) && std::isinf(v.parameter(upper)) && !has_command(v);
  }
  /// Its limits; the ends of the band in which clamping fades out; the limits of the rate.
  static void kinks(const View<double>& v) {
    const auto w = wanted(v);
    const double low = v.parameter(lower), high = v.parameter(upper);
    double* out = v.out;
    *out++ = w.command - low;
    *out++ = w.command - high;
    if (v.choice(anti_windup) == static_cast<int>(pid::AntiWindup::clamping)) {
      const double band = pid::clamping_band * (high - low);
      *out++ = w.command - high - band;
      *out++ = w.command - low + band;
      *out++ = w.integral_rate;
    }
    if (has_command(v)) {
      *out++ = asked(v, w.command) - v.parameter(rate);
      *out++ = asked(v, w.command) + v.parameter(rate);
    }
  }
  /// Through a row that is long beside follow_time, which one step of Runge-Kutta would not see to turn.
  class OwnStep {
   public:
    explicit OwnStep(const View<double>& v) : view_(v) {}
    bool takes(double h) const { return has_command(view_) && h > longest(); }
    void operator()(double* x, const double* from, const double* to, double h) {
      const int steps = static_cast<int>(std::ceil(h / longest()));
      std::array<double, 3> u{};
      std::array<double, 15> work{};
      View<double> v = view_;
      v.u = u.data();
      for (int i = 0; i < steps; ++i)
        block_detail::runge_kutta(v.n_x, x, h / steps, work.data(), [&](double c, const double* at, double* dx) {
          const double share = (i + c) / steps;
          for (int k = 0; k < v.n_u; ++k) u[static_cast<std::size_t>(k)] = from[k] + share * (to[k] - from[k]);
          v.x = at;
          v.out = dx;
          derivative(v);
        });
    }

   private:
    double longest() const { return 0.5 * view_.parameter(follow_time); }
    View<double> view_;
  };

  static void initial_states(const View<double>& v) {
    v.out[integral] = v.parameter(initial);
    v.out[filtered] = 0;
    if (has_command(v)) v.out[command] = limited(v, v.parameter(initial));
  }
};

Kernel pid_block();
Kernel pid_tracking_block();

}  // namespace hysteron::blocks
