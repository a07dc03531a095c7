// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/coupled/layout.hpp"
#include "core/coupled/vessel.hpp"

namespace tunica::coupled {

/// What a time scheme makes of the state at the time where the equations hold: rate = coefficient y + history
/// for every entry. Coefficient 0 and history 0 give the steady equations.
struct Stage {
  double time = 0;
  double coefficient = 0;
  std::span<const double> history;  ///< empty for 0
  /// Displacement that the mesh in the blood has off the wall, and its rate, where they are given and not
  /// those of the state; entries as in y.
  std::span<const double> mesh = {}, mesh_rate = {};
  /// Greatest wall pressure that the derivative knows, dyn/cm2 (kernel::WallParameters).
  double wall_pressure_bound = std::numeric_limits<double>::infinity();
};

inline double rate(const Stage& stage, std::span<const double> y, std::size_t entry) {
  const double history = stage.history.empty() ? 0 : stage.history[entry];
  return stage.coefficient * y[entry] + history;
}

/// A direction in which state and stage change with a parameter: the derivatives of the state, and a stage
/// whose history and mesh are those of the stage's.
struct Direction {
  Stage stage;
  std::span<const double> y;
};

/// Smallest Jacobian of the deformation found, and where.
struct LeastJacobian {
  double value = 1;
  int cell = -1;
};

/// Flow out through an opening, cm3/s, and the part of it that leaves where blood goes outwards.
struct Throughflow {
  double net = 0, leaving = 0;
  void add(double flow, double outwards) {
    net += flow;
    leaving += outwards;
  }
};

/// The derivative of a residual at a state, and solutions with it.
class TangentSolver {
 public:
  virtual ~TangentSolver() = default;
  /// Computes the derivative at a complete state and prepares solutions with it. False when it is singular.
  virtual bool factorise(const Stage& stage, std::span<const double> y) = 0;
  /// Overwrites a right-hand side with the solution. Needs a factorisation. False when no solution was
  /// found: the right-hand side is then of no use.
  virtual bool solve(std::span<double> right_hand_side) = 0;
  /// Of the latest solution: 1 with factors, more with a Krylov method.
  virtual long iterations() const { return 1; }
  /// Forgets all that the next factorisation could depend on but its matrix.
  virtual void forget() = 0;
  /// Entries of the latest factors, a measure of their cost.
  virtual double entries() const = 0;
};

/// The coupled equations of blood, wall and the motion of the mesh, discretised in space.
///
/// Rows are numbered as the unknowns: displacement on the wall <- momentum of wall and blood together;
/// displacement in the blood <- mesh motion; velocity <- momentum of the blood; pressure <- continuity;
/// scalars <- their own equations.
class Equations {
 public:
  virtual ~Equations() = default;
  virtual const Layout& layout() const = 0;
  /// Puts the prescribed values and the wall's velocities in place.
  virtual void complete(const Stage& stage, std::span<double> y) const = 0;
  /// Residual at a complete state. False when some cell is inverted or a value is not finite: `residual` is
  /// then of no use.
  virtual bool residual(const Stage& stage, std::span<const double> y, std::span<double> residual) const = 0;
  /// Moves the mesh in the blood after the wall where it is none of the unknowns (Layout::mesh_follows).
  virtual void follow(double /*time*/, std::span<double> /*y*/) const {}
  /// Of the latest residual.
  virtual const LeastJacobian& least_jacobian() const = 0;
  /// The derivative is exact, by duals, the motion of the mesh included where it is unknown. The equations
  /// must outlive it.
  virtual std::unique_ptr<TangentSolver> tangent_solver() const = 0;

  /// Through a boundary of the blood at a complete state; nothing without blood.
  virtual Throughflow flow(const Stage& stage, std::span<const double> y, Boundary boundary) const = 0;

  virtual bool has_wall() const = 0;
  virtual bool has_blood() const = 0;
  /// Shares of the nodes in the volume of the wall, or in that of the blood where no wall is computed.
  virtual std::vector<double> volume_shares() const = 0;

  /// Where a node is in the unloaded vessel, for messages: "r = 0.03, z = 0.2 cm (cell 7 of 90)".
  virtual std::string place_of_node(int node) const = 0;
  /// What became of a cell that is compressed to the Jacobian given or turned inside out, where, and what
  /// may help.
  virtual std::string compression(const LeastJacobian& least) const = 0;
};

}  // namespace tunica::coupled
