// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>
#include <vector>

/// Steps in time for implicit systems F(y, dy/dt, t) = 0, ordinary or differential-algebraic.
namespace tunica::time {

enum class Method { bdf2, backward_euler, generalized_alpha };

/// A step to be taken: its size, and the time at its end. These are given apart so that steps of equal size
/// have bitwise equal coefficients and yet end exactly on a wanted time.
struct Step {
  double size;
  double end_time;
};

/// Where F is made zero: at `time`, with dy/dt = coefficient y + history for every entry of y.
struct Stage {
  double step = 0;      ///< h
  double end_time = 0;  ///< t_(n+1)
  double time = 0;      ///< t*, at which y* and the data of the problem are taken
  double coefficient = 0;
  int order = 0;  ///< of the step: 1 for a first step by backward Euler
};

/// Time schemes with variable step. A step solves F(y*, c y* + history, t*) = 0 for y*:
///
/// backward Euler     t* = t_(n+1), y* = y_(n+1), r* = (y* - y_n)/h.
/// bdf2               t* = t_(n+1), y* = y_(n+1), r* = slope at t* of the parabola through y*, y_n, y_(n-1):
///                      c = 1/h + 1/(h+h'), h' the step before. The first step is one of backward Euler.
///                      Zero-stable while no step exceeds 2.41 times the one before.
/// generalized alpha  (Jansen, Whiting, Hulbert 2000) with rates r_n kept beside the values:
///                      y* = y_n + af (y_(n+1) - y_n),  t* = t_n + af h,  r* = r_n + am (r_(n+1) - r_n),
///                      y_(n+1) = y_n + h ((1-g) r_n + g r_(n+1)),  af = 1/(1+rho).
///                    Elimination of y_(n+1) and r_(n+1): c = am/(g af h), history = (1 - am/g) r_n - c y_n.
///                    With equal steps am = (3-rho)/(2(1+rho)), g = 1/2 + am - af, and r_n is to second order
///                    the rate at t_n + s h, s = af - am = (rho-1)/(2(1+rho)). When the step changes, these
///                    am and g would be of first order. With r_n the rate at t_n + o (o = s h', or 0 for a
///                    rate that was given),
///                      am = (af h - o)/(h + s h - o),  g = (h/2 - o)/(h + s h - o)
///                    keep the second order and make r_(n+1) the rate at t_(n+1) + s h. Where F has no rate,
///                    or is infinitely stiff, a step multiplies y by -rho, and r by a factor within [-1, 0]
///                    for any ratio of steps (-rho for equal ones). With rho = 0 this is bdf2.
///                    Without a rate at the start, the first step is one of backward Euler.
///
/// Entries without a rate in F (pressures) are treated as the others. Those that only the derivative of a
/// constraint determines (index 2) keep the order under bdf2 for any steps; under generalized alpha with
/// rho > 0 they are of first order after an abrupt change of step, until that has decayed as n rho^n.
class Scheme {
 public:
  /// `spectral_radius` is rho, in [0, 1], used by generalized_alpha only.
  explicit Scheme(Method method, double spectral_radius = 0.5);

  /// Begins at `time` and forgets the past, as is needed after a discontinuity. `rate` is dy/dt there, or
  /// empty when it is not known: then the first step has no error estimate. Estimates of the first
  /// steps are useless for entries that jump away from their values here, as pressures may after a load has.
  void start(double time, std::vector<double> value, std::vector<double> rate = {});

  /// Prepares a step from time(). May be called again with another step when the step is rejected.
  const Stage& begin(const Step& step);
  const Stage& begin(double step) { return begin({step, time_ + step}); }
  const Stage& stage() const { return stage_; }
  /// r* = stage().coefficient y* + history().
  std::span<const double> history() const { return history_; }
  /// Guess of y*: polynomial through the last accepted values, as many as order + 1 when there are; at
  /// the start y + (t* - t) dy/dt.
  std::span<const double> prediction() const { return prediction_; }

  /// First entries of the values and rates to be expected at the time of the stage: linear through the last
  /// two of each, as far as there are.
  void expect(std::span<double> values, std::span<double> rates) const;

  /// y_(n+1) from y*.
  void end_value(std::span<const double> stage_value, std::span<double> out) const;

  /// Estimated local truncation error of y_(n+1), computed minus exact. With D the departure of r_(n+1)
  /// from the polynomial through the rates of the past,
  ///   first order   D/(2c),  D = r_(n+1) - r_n
  ///   bdf2          D/(3c),  D = r_(n+1) - linear extrapolation of r_n and r_(n-1)
  /// Both are the leading term of the error for any sequence of steps (from values alone, irregular steps
  /// would spoil it). That of generalized alpha is E h^3 y''' with y''' from D as for bdf2 and
  /// E = 1/12 - s^2 + s (1 - 2 am)/2, which is exact for linear autonomous systems and equal steps.
  /// Where a second-order method has one rate of the past only, the estimate is that of backward Euler,
  /// which is too large.
  ///
  /// A norm that steps are chosen by must not take every entry as it is. A change of step moves by h^2
  ///  - entries that F gives as the rate of another that does not depend on them (the velocity of a wall
  ///    that follows the pressure) or that only the derivative of a constraint determines. Smaller steps do
  ///    not bring this below a tolerance that falls as h^3: weigh such entries by the step or leave them out;
  ///  - under generalized alpha with rho > 0, all that follows others without inertia. It costs many steps:
  ///    that method is for equal ones.
  void error(std::span<const double> stage_value, std::span<double> out) const;
  /// p when the estimate for the step begun is of the order h^(p+1); 0 without estimate.
  int error_order() const;
  bool has_error_estimate() const { return error_order() > 0; }

  /// Takes the step that was begun.
  void accept(std::span<const double> stage_value);

  double time() const { return time_; }
  const std::vector<double>& value() const { return values_[0]; }
  /// The scheme's own rate r_n; under generalized alpha it belongs to time() + rate_offset().
  const std::vector<double>& rate() const { return rates_[0]; }
  double rate_offset() const { return rate_offsets_[0]; }

  /// Values at a time within the last accepted step: polynomial through the last accepted values, of
  /// degree 1 for backward Euler and 2 otherwise (1 after the first step). Continuous from step to step.
  void interpolate(double time, std::span<double> out) const;

  /// What a run that is resumed between two steps needs to go on bitwise the same.
  struct Saved {
    double time = 0;
    int steps = 0;  ///< accepted since the start, counted to 2
    bool rate_given = false;
    std::array<double, 2> step_sizes{};
    std::array<double, 2> rate_offsets{};
    std::vector<std::vector<double>> values;  ///< y_n, y_(n-1), y_(n-2), as far as there are
    std::vector<std::vector<double>> rates;   ///< r_n, r_(n-1), as far as there are
  };
  Saved save() const;
  /// The scheme must have been made with the same method and radius.
  void restore(const Saved& saved);

 private:
  bool first_order() const;
  int known_rates() const;
  int degree() const;
  /// The polynomial through the last values at `ahead` of time().
  void polynomial(double ahead, std::span<double> out) const;
  void end_rate(std::span<const double> stage_value, std::span<double> out) const;
  double end_rate_offset() const;

  Method method_;
  double af_, shift_, error_constant_;
  double time_ = 0;
  int steps_ = 0;                              // accepted since the start, counted to 2
  bool rate_given_ = false;                    // at the start
  std::array<double, 2> step_sizes_{};         // of the last steps, the latest first
  std::array<double, 2> rate_offsets_{};       // times of the rates less those of the values
  std::array<std::vector<double>, 3> values_;  // the latest first
  std::array<std::vector<double>, 2> rates_;   // the latest first
  Stage stage_;
  double am_ = 1;  // of the step begun
  std::vector<double> history_, prediction_;
};

}  // namespace tunica::time
