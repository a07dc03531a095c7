// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/coupled/equations.hpp"

namespace tunica::coupled {

struct NewtonOptions {
  /// Error allowed in each field (displacement, velocity, pressure), relative to the greatest value of that
  /// field.
  double tolerance = 1e-8;
  int most_iterations = 60;
  /// A damped step may enlarge the correction that is left by this factor instead of diminishing it: for
  /// guesses whose first errors are of a kind that Newton's method trades for others.
  double growth = 0;
};

struct NewtonReport {
  bool converged = false;
  int iterations = 0;
  std::string failure;  ///< why it did not converge
  /// Entry of the state that the last iteration wanted to change most, relative to the size of its field.
  std::optional<std::size_t> worst;
};

/// Counts since the solver was made.
struct NewtonCounts {
  long iterations = 0, factorisations = 0;
  long linear_iterations = 0;  ///< TangentSolver::iterations of all solutions

  NewtonCounts& operator+=(const NewtonCounts& other) {
    iterations += other.iterations;
    factorisations += other.factorisations;
    linear_iterations += other.linear_iterations;
    return *this;
  }
};

/// Newton's method for the coupled equations of one stage.
///
/// A factorised derivative is kept from iteration to iteration and from step to step, and improved
/// by Broyden's rank-one updates (Kelley, Solving Nonlinear Equations with Newton's Method, SIAM 2003), for
/// as long as that converges well: a factorisation costs as much as many iterations. Otherwise the derivative
/// is computed anew, and iterations that would not approach the solution are damped by the natural
/// monotonicity test (Deuflhard, Newton Methods for Nonlinear Problems, Springer 2004).
class Newton {
 public:
  /// The equations must outlive it.
  explicit Newton(const Equations& equations);

  /// Solves for the unknowns in `y`, from the values that it holds. Prescribed entries and the wall's
  /// velocities are put in place. When it does not converge, y is of no use.
  NewtonReport solve(const Stage& stage, std::span<double> y, const NewtonOptions& options);

  /// Computes the derivative at a complete state and factorises it, for linearised() and for what is solved
  /// next. False when it is singular.
  bool refresh(const Stage& stage, std::span<const double> y);
  /// Overwrites a right-hand side with the solution of the equations linearised where the derivative was last
  /// computed. False when none was found.
  bool linearised(std::span<double> right_hand_side);

  /// Drops the factorisation, so that what follows does not depend on what came before.
  void forget();

  /// Greatest absolute values of displacement, velocity and pressure of the solutions so far, which errors
  /// are measured by. Part of the state of a run.
  struct Sizes {
    double displacement = 0, velocity = 0, pressure = 0;
  };
  const Sizes& sizes() const { return sizes_; }
  void set_sizes(const Sizes& sizes) { sizes_ = sizes; }

  const NewtonCounts& counts() const { return counts_; }
  /// Entries of the latest factorisation.
  double factor_entries() const { return solver_->entries(); }

 private:
  enum class Outcome { converged, slow, failed };

  bool evaluate(const Stage& stage, std::span<double> y);
  /// correction = -(derivative)^-1 residual; not finite where no solution was found.
  void correct(std::vector<double>& correction);
  void add(std::span<double> y, double factor, const std::vector<double>& correction) const;
  Sizes sizes_with(std::span<const double> y) const;
  /// Sets the weights by the sizes so far and those of y, which are not kept: iterates may be far off.
  void weigh(std::span<const double> y);
  using Norms = std::array<double, 3>;  ///< greatest scaled entry of displacement, velocity and pressure
  Norms norms(const std::vector<double>& correction) const;
  static double norm(const Norms& norms);
  std::size_t greatest(const std::vector<double>& correction) const;
  /// Why the latest residual is of no use.
  const char* flaw() const;
  double inner(const std::vector<double>& a, const std::vector<double>& b) const;
  Outcome iterate(const Stage& stage, std::span<double> y, const NewtonOptions& options,
                  NewtonReport& report);
  bool damped_step(const Stage& stage, std::span<double> y, const NewtonOptions& options,
                   NewtonReport& report, bool& converged);

  const Equations& equations_;
  std::unique_ptr<TangentSolver> solver_;
  bool factorised_ = false;
  std::vector<double> residual_, weights_;
  Sizes sizes_;
  NewtonCounts counts_;
};

}  // namespace tunica::coupled
