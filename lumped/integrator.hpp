// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

namespace tunica::lumped {

struct IntegratorStatistics {
  long steps = 0;
  long newton_iterations = 0;
  long rejected_steps = 0;
};

/// A system of ordinary differential equations y' = f(t, y; theta) with a banded Jacobian.
struct System {
  int unknowns = 0;
  int bandwidth = 0;
  bool oscillates = false;     ///< has weakly damped oscillations faster than what is of interest
  double time_scale = 1;       ///< s, that things of interest happen within
  std::vector<double> scales;  ///< typical magnitude of each unknown
  /// What the error of each unknown is relative to at y, all above 0.
  std::function<void(const double* y, double* magnitudes)> magnitudes;
  std::function<void(double t, const double* y, double* rate)> rate;
  /// Derivative of f along dy plus, for k >= 0, along parameter k.
  std::function<void(double t, const double* y, const double* dy, int k, double* result)> rate_derivative;
  /// Told now and then how far an integration has come.
  std::function<void(double t, const IntegratorStatistics& so_far)> progress;
  /// Functions of y whose zeros are reported, with their number.
  int events = 0;
  std::function<void(const double* y, double* values)> event_values;
};

/// A zero of event function `index`; it grows through zero when `rising`.
struct Crossing {
  int index;
  bool rising;
};

/// A forward sensitivity that is carried along: s' = (df/dy) s + df/dtheta.
struct Sensitivity {
  int parameter;  ///< theta; -1 for a derivative with respect to an initial value
  double size;    ///< expected magnitude of s_i over scale_i, for the absolute tolerance
};

/// After so many steps the system is told, and unless they have brought this share of its time scale the
/// integration counts as stuck.
inline constexpr long steps_at_a_time = 1000;
inline constexpr double least_share = 1e-5;

/// Follows a system in time.
class Integrator {
 public:
  virtual ~Integrator() = default;

  /// Sets the state at `time` and, one vector per sensitivity, its derivatives. The integration is not
  /// carried beyond `end_time`, where the right-hand side need not exist.
  virtual void start(double time, double end_time, const std::vector<double>& state,
                     const std::vector<std::vector<double>>& sensitivities) = 0;

  /// Goes on to `time` or to the first crossing before it, whichever comes first; returns the
  /// crossings met (empty: `time` was reached). Throws SolverFailure with the reason, also when steps have
  /// become so short that they lead nowhere.
  virtual std::vector<Crossing> advance(double time) = 0;

  virtual double time() const = 0;
  virtual const double* state() const = 0;
  /// Derivative number k of the state at time(); computed for the time that advance stopped at.
  virtual const double* sensitivity(int k) const = 0;
  virtual IntegratorStatistics statistics() const = 0;
};

}  // namespace tunica::lumped
