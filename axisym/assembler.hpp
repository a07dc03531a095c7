// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "axisym/direct_solver.hpp"
#include "axisym/layout.hpp"
#include "axisym/tables.hpp"

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
  explicit Assembler(const Problem& problem);

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
  SparseMatrix pattern() const { return pattern_; }
  /// Fills `matrix` (from pattern()) with the derivative at a complete state.
  void tangent(const Stage& stage, std::span<const double> y, SparseMatrix& matrix) const;

  /// Flow out through a boundary of the blood, cm3/s, at a complete state.
  double flow(const Stage& stage, std::span<const double> y, Boundary boundary) const;

 private:
  /// Unknowns of a cell's or side's test and trial functions, -1 where there is none, [component][function].
  struct Numbers {
    std::array<std::array<int, cell_width>, 2> momentum, mesh, velocity, displacement;
    std::array<int, cell_width> continuity, pressure;
    std::array<bool, cell_width> adheres;  ///< the velocity is the rate of the displacement
  };
  /// A cell's or side's numbers, and the places in the matrix of its entries in the order in which scatter()
  /// visits them.
  struct Targets {
    Numbers numbers;
    std::vector<int> places;
  };
  struct ScalarRow {
    std::size_t entry;  ///< of y
    double factor;      ///< on the flow out
  };

  Numbers cell_numbers(int cell) const;
  Numbers side_numbers(const SideTable& side) const;
  void build_pattern();
  std::vector<ScalarRow> scalar_rows(Boundary boundary) const;
  /// Entry of y that holds the pressure on a boundary, none when there is no such unknown.
  std::optional<std::size_t> pressure_entry(Boundary boundary) const;
  bool is_loaded(const SideTable& side) const;
  double pressure_on(const SideTable& side, const Stage& stage, std::span<const double> y) const;

  void add_sides(const Stage& stage, std::span<const double> y, std::span<double> residual) const;
  void add_scalars(const Stage& stage, std::span<const double> y, std::span<double> residual) const;
  void add_loads(double time, std::span<double> residual) const;

  const Problem& problem_;
  Layout layout_;
  Tables tables_;
  SparseMatrix pattern_;
  std::vector<Targets> blood_targets_, wall_targets_, side_targets_;
  mutable LeastJacobian least_;
};

}  // namespace tunica::axisym
