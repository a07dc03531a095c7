// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/time/scheme.hpp"

namespace tunica::time {

/// What to do with a step that was tried. With give_up the step cannot be made smaller.
enum class Verdict { accept, retry, give_up };

struct StepOptions {
  double first = 0;    ///< s, at the start and, at most, after each restart; in fixed mode every step
  double minimum = 0;  ///< s
  double maximum = 0;  ///< s
  bool fixed = false;  ///< errors are not looked at
  double safety = 0.9;
  double growth = 2;  ///< greatest ratio of a step to the one before; bdf2 needs less than 2.41
  /// The step wanted is changed only when its ratio to the present one is outside, as another step costs
  /// a factorisation.
  double keep_from = 0.9, keep_to = 1.3;
};

/// Chooses steps. For each:
///   const Step step = control.next(time, stop);
///   then control.judge(norm of the error, its order) where it was solved, else control.solve_failed().
///
/// A step is accepted when the norm of its error is at most 1. With errors of the order h^(p+1), the next
/// step is the smaller of
///   elementary    h safety err^(-1/(p+1)),
///   predictive    h safety err^(-1/(p+1)) (h/h_before) (err_before/err)^(1/(p+1))  (Gustafsson 1994),
/// the latter after two accepted steps of like size in a row. A PI controller would not do: where steps are
/// left as they are, its answer to a small error is too weak to leave the band.
///
/// The time to the stop is divided evenly into as few steps as are no longer than wanted (where a tenth of
/// one would be left over, the others are stretched). So steps stay equal up to the stop, it is met exactly,
/// and the last step is no sliver.
///
/// A step that cannot be solved is halved, and quartered when it fails again; the next steps do not grow. In
/// fixed mode its end is met by the smaller steps; steps then double until they are as before.
class StepControl {
 public:
  /// Throws std::logic_error unless 0 < minimum <= first <= maximum and growth > keep_to > 1 > keep_from.
  explicit StepControl(const StepOptions& options);

  /// The step to try from `time`, not beyond `stop` > time.
  Step next(double time, double stop);
  /// The step was solved, with this norm of its error, of the given order p. Order 0: there is no estimate;
  /// the step is accepted and the next is as long. A norm that is not finite rejects.
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
    double wanted = 0;        ///< step
    double tried = 0;         ///< the last that next() gave
    double tried_end = 0;     ///< its end
    double regular = 0;       ///< fixed mode: the last that was not divided
    double cell_end = 0;      ///< fixed mode: end of the step that is divided
    bool divided = false;     ///< fixed mode: whether one is
    double accepted = 0;      ///< the last step accepted since the (re)start, 0: none
    double error_before = 0;  ///< its error
    int order_before = 0;     ///< the order of that error, 0: none
    int failed = 0;           ///< times that the present step could not be solved
    int rejected = 0;         ///< times that its error was too large
    int hold = 0;             ///< accepted steps to come that do not grow
    Counts counts;
  };
  const Saved& save() const { return state_; }
  void restore(const Saved& saved) { state_ = saved; }

 private:
  void accept(double error, int order);
  bool at_floor() const;

  StepOptions options_;
  Saved state_;
};

}  // namespace tunica::time
