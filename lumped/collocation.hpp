// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <optional>
#include <string>

#include "lumped/integrator.hpp"

namespace tunica::lumped {

/// Collocation at the three Radau points of each step, for systems of a few unknowns whose states are asked
/// for at many times: Radau IIA of order 5, implicit and L-stable (Hairer and Wanner, Solving Ordinary
/// Differential Equations II, IV.5 and IV.8).
///   Y_i = y_0 + h sum_j a_ij f(t_0 + c_j h, Y_j),  y_1 = Y_3,
/// solved by Newton's method with df/dy of an earlier step for as long as that converges quickly. Between
/// their ends steps are read from the polynomial through y_0 and Y_i, whose error is of the order of that of
/// the embedded formula of order 3, which steps are chosen by. Crossings are found on it. Carries no
/// sensitivities.
class Collocation final : public Integrator {
 public:
  /// Dense systems of three times as many unknowns are solved.
  static constexpr int most_unknowns = 4;

  /// `tolerance` is what the embedded formula may be off by in a step, relative to the system's magnitudes;
  /// the step itself is far better. Throws std::logic_error for more than most_unknowns.
  Collocation(System system, double tolerance);

  /// `sensitivities` has to be empty.
  void start(double time, double end_time, const std::vector<double>& state,
             const std::vector<std::vector<double>>& sensitivities) override;
  std::vector<Crossing> advance(double time) override;
  double time() const override { return time_; }
  const double* state() const override { return state_.data(); }
  const double* sensitivity(int k) const override;
  IntegratorStatistics statistics() const override { return statistics_; }

 private:
  static constexpr int stages = 3;
  using State = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_unknowns, 1>;
  using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_unknowns, most_unknowns>;
  /// Y_i - y_0, one column for each stage.
  using Stages = Eigen::Matrix<double, Eigen::Dynamic, stages, 0, most_unknowns, stages>;
  using StageVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_unknowns * stages, 1>;
  using StageSquare = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_unknowns * stages,
                                    most_unknowns * stages>;

  /// The step over h from where the last one ends; false when Newton's method does not converge.
  bool solve(double h);
  bool iterate(double h);
  /// The polynomial of the last step, from 0 at its beginning to 1 at its end and on.
  State change_at(double share) const;
  Stages guess(double h) const;
  /// Of the step just solved, relative to the tolerance.
  double error_of(double h, bool is_careful) const;
  void differentiate();
  void factorise(double h);
  /// Takes the next step, that is, one that meets the tolerance.
  void step();
  void accept(double end);
  /// Throws SolverFailure when steps lead nowhere.
  void shorten(double h, double factor);
  /// The state at a time within the last step.
  State within(double time) const;
  /// The first crossing from time() to `until` within the last step, to which it goes.
  std::optional<Crossing> cross(double until);

  System system_;
  double tolerance_;
  double time_ = 0, end_time_ = 0;
  State state_;                 ///< at time()
  double begin_ = 0, end_ = 0;  ///< of the last step; the same at a start
  State at_begin_, at_end_;     ///< the states there
  Stages stages_, solved_;      ///< of the last step and of the one tried
  State rate_, magnitudes_;     ///< where the last step ends
  double step_ = 0;             ///< that the error suggests
  Square jacobian_;
  bool is_jacobian_due_ = true, is_jacobian_of_end_ = false;
  double factorised_step_ = 0;  ///< 0: none
  double convergence_ = 1;      ///< of Newton's method: what an update leaves of the error over itself
  Eigen::PartialPivLU<StageSquare> stage_solver_;
  Eigen::PartialPivLU<Square> error_solver_;
  std::vector<double> event_values_;  ///< at the latest state that they were asked for
  std::vector<bool> sides_;           ///< of the event functions at time(): above zero
  std::string complaint_;             ///< what the right-hand side said when it could not be computed
  IntegratorStatistics statistics_;
};

}  // namespace tunica::lumped
