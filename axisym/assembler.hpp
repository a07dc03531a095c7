// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "axisym/matrix_map.hpp"
#include "core/threads.hpp"

namespace tunica::axisym {

/// What a time scheme makes of the state at the time where the equations hold: rate = coefficient y + history
/// for every entry. Coefficient 0 and history 0 give the steady equations.
struct Stage {
  double time = 0;
  double coefficient = 0;
  std::span<const double> history;  ///< empty for 0
};

/// Smallest Jacobian of the deformation found, and where.
struct LeastJacobian {
  double value = 1;
  int cell = -1;
};

/// Residual of the coupled equations and its derivative by the unknowns.
///
/// Rows are numbered as the unknowns: displacement on the wall <- momentum of wall and blood together;
/// displacement in the blood <- mesh motion; velocity <- momentum of the blood; pressure <- continuity;
/// scalars <- their own equations. The derivative is exact, by duals, the motion of the mesh included.
class Assembler {
 public:
  /// The problem must outlive it. On meshes of a few hundred cells and more so many threads share the work;
  /// results do not depend on them.
  explicit Assembler(const Problem& problem, int threads = available_threads());
  Assembler(const Assembler&) = delete;
  Assembler& operator=(const Assembler&) = delete;

  const Problem& problem() const { return problem_; }
  const Layout& layout() const { return layout_; }
  const Tables& tables() const { return tables_; }

  /// Puts the prescribed values and the wall's velocities in place.
  void complete(const Stage& stage, std::span<double> y) const;

  /// Residual at a complete state. False when some cell is inverted or a value is not finite: `residual` is
  /// then of no use.
  bool residual(const Stage& stage, std::span<const double> y, std::span<double> residual) const;
  /// Of the latest residual.
  const LeastJacobian& least_jacobian() const { return least_; }

  /// A matrix with the pattern of the derivative.
  SparseMatrix pattern() const { return map_.pattern(); }
  /// Fills `matrix` (from pattern()) with the derivative at a complete state.
  void tangent(const Stage& stage, std::span<const double> y, SparseMatrix& matrix) const;

  /// Flow out through a boundary of the blood, cm3/s, at a complete state.
  double flow(const Stage& stage, std::span<const double> y, Boundary boundary) const;

 private:
  double pressure_on(const SideTable& side, const Stage& stage, std::span<const double> y) const;

  void add_sides(const Stage& stage, std::span<const double> y, std::span<double> residual) const;
  void add_scalars(const Stage& stage, std::span<const double> y, std::span<double> residual) const;
  void add_loads(double time, std::span<double> residual) const;

  const Problem& problem_;
  int threads_;
  Layout layout_;
  Tables tables_;
  MatrixMap map_;
  mutable LeastJacobian least_;
};

}  // namespace tunica::axisym
