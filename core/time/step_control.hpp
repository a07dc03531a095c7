// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/time/scheme.hpp"

namespace tunica::time {

/// What to do with a step that was tried. With give_up the step cannot be made smaller.
enum class Verdict { accept, retry, give_up };

struct StepOptions {
  double first = 0;    ///< s, at the start and after each restart; in fixed mode the step
  double minimum = 0;  ///< s
  double maximum = 0;  ///< s
  bool fixed = false;  ///< errors are not looked at
  double safety = 0.9;
  double growth = 2;  ///< greatest ratio of a step to the one before
  /// A step whose wanted ratio to the present one lies within is left as it is: another coefficient costs
  /// a factorisation.
  double keep_from = 0.9, keep_to = 1.3;
};

/// Chooses steps. For each step:
///   const Step step = control.next(time, stop);
///   solve; where that fails, control.solve_failed(), otherwise control.judge(norm of the error, its order).
///
/// An error norm of 1 is the limit; steps above it are rejected. A PI controller (Gustafsson 1991) wants
///   h_new = h safety err^(-0.7/(p+1)) err_before^(0.4/(p+1))
/// after an accepted step and h safety err^(-1/(p+1)) after a rejected one. The time to the next stop is
/// always divided evenly, so that steps stay equal until a stop, which is met exactly and without a sliver.
/// A step that cannot be solved is halved, and quartered when it fails again; steps then do not grow for a
/// while. In fixed mode such a step is divided, and its end is met; then steps are as before.
class StepControl {
 public:
  /// Throws InvalidInput unless 0 < minimum <= first <= maximum.
  explicit StepControl(const StepOptions& options);

  /// The step to try from `time`, not beyond `stop` > time.
  Step next(double time, double stop);
  /// The step was solved, with this norm of its error. Order 0: no estimate, the step is accepted.
  Verdict judge(double error, int order);
  /// The equations of the step were not solved.
  Verdict solve_failed();
  /// After a discontinuity: steps begin again with options().first, or the present one when it is smaller.
  void restart();

  const StepOptions& options() const { return options_; }
  struct Counts {
    long accepted = 0, rejected_by_error = 0, rejected_by_solver = 0;
  };
  const Counts& counts() const { return state_.counts; }

  /// What a run that is resumed between two steps needs to go on bitwise the same.
  struct Saved {
    double size = 0;          ///< of the steps wanted
    double tried = 0;         ///< of the last step that next() gave
    double tried_end = 0;     ///< its end
    double accepted = 0;      ///< of the last step accepted since the start, 0: none
    double error_before = 0;  ///< of the last step accepted, 0: none
    int order_before = 0;
    double cell_end = 0;  ///< fixed mode: end of the step that is divided, if `divided`
    bool divided = false;
    int failures = 0;    ///< solver's, since the last accepted step
    int rejections = 0;  ///< by error, since the last accepted step
    int hold = 0;        ///< accepted steps to come that do not grow
    Counts counts;
  };
  const Saved& save() const { return state_; }
  void restore(const Saved& saved) { state_ = saved; }

 private:
  StepOptions options_;
  Saved state_;
};

}  // namespace tunica::time
