// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <string>
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

/// Variable-order, variable-step BDF of CVODES with staggered forward sensitivities and root finding.
class Integrator {
 public:
  /// `tolerance` is relative and local, that is, per step. Sensitivities take part in the control of
  /// the step, or follow the steps that suit the state.
  enum class SensitivityErrors { controlled, followed };
  Integrator(System system, std::vector<Sensitivity> sensitivities, double tolerance,
             SensitivityErrors errors = SensitivityErrors::controlled);
  ~Integrator();
  Integrator(Integrator&&) noexcept;
  Integrator& operator=(Integrator&&) noexcept;

  /// Sets the state at `time` and, one vector per sensitivity, its derivatives. The integration is not
  /// carried beyond `end_time`, where the right-hand side need not exist.
  void start(double time, double end_time, const std::vector<double>& state,
             const std::vector<std::vector<double>>& sensitivities);

  /// Goes on to `time` or to the first crossing before it, whichever comes first; returns the
  /// crossings met (empty: `time` was reached). Throws SolverFailure with the reason, also when steps have
  /// become so short that they lead nowhere.
  std::vector<Crossing> advance(double time);

  double time() const;
  const double* state() const;
  /// Derivative number k of the state at time(); computed for the time that advance stopped at.
  const double* sensitivity(int k) const;
  IntegratorStatistics statistics() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace tunica::lumped
