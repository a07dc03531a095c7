// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "core/coupled/equations.hpp"
#include "core/coupled/mesh_extension.hpp"
#include "full3d/layout.hpp"

namespace tunica::full3d {

using coupled::LeastJacobian;

/// A stage with what the boundaries carry at its time: pressures by Boundary, dyn/cm2.
struct LoadedStage {
  coupled::Stage stage;
  std::array<double, coupled::boundaries> pressure{};
};

/// A place in the matrix.
struct MatrixPlace {
  int row, column;
};

/// Residual and derivative of some of a problem's cells and of the faces that belong to them. Rows and
/// columns are numbered as the layout's unknowns.
class CellWork {
 public:
  virtual ~CellWork() = default;
  /// Adds to `residual` (all unknowns). Cells that are turned inside out add nothing of use.
  virtual LeastJacobian residual(const LoadedStage& stage, std::span<const double> y,
                                 std::span<double> residual) const = 0;
  /// The places of the derivative's entries; places may repeat. Those of a bubble are left out: it is
  /// condensed.
  virtual std::vector<MatrixPlace> pattern() const = 0;
  /// The entries, in the order of pattern(). Keeps what condense() and recover() need.
  virtual void tangent(const LoadedStage& stage, std::span<const double> y, std::span<double> values) = 0;
  /// Unknowns of the cells' bubbles, which the derivative leaves out.
  virtual std::vector<int> condensed() const = 0;
  /// Adds what the condensed unknowns' rows of a right-hand side are to the other rows to `change`.
  virtual void condense(std::span<const double> right, std::span<double> change) const = 0;
  /// Sets the condensed unknowns of a solution from the others.
  virtual void recover(std::span<const double> right, std::span<double> solution) const = 0;
  /// Adds the loads of Conditions::loads at a time, with their sign in the residual.
  virtual void add_loads(double time, std::span<double> residual) const = 0;
  /// Adds the blood's cells to the equations of the mesh alone, and the loads of a time on them.
  virtual void add_mesh(coupled::MeshExtension& extension) const = 0;
  virtual void add_mesh_loads(double time, const coupled::MeshExtension& extension,
                              std::span<double> loads) const = 0;
  /// Flow out through a boundary of the blood, cm3/s.
  virtual coupled::Throughflow flow(const coupled::Stage& stage, std::span<const double> y,
                                    Boundary boundary) const = 0;
  /// Adds the volumes (cm3) of the nodes of a part to `volumes`, by node.
  virtual void add_volumes(Part part, std::span<double> volumes) const = 0;
  /// Adds the blood's volume to the nodes of velocity, shared out as the squares of their shape functions so
  /// that none is negative, and to those of pressure, both by node (cm3).
  virtual void add_blood_volumes(std::span<double> velocity, std::span<double> pressure) const = 0;
};

/// Work on the cells of these indices, on so many threads; results do not depend on their number. With
/// `condense` bubbles are condensed. Problem and layout must outlive it.
std::unique_ptr<CellWork> cell_work(const Problem& problem, const Layout& layout,
                                    const std::vector<int>& cells, int threads, bool condense);

/// Cost of a cell's derivative, relative to that of a blood cell, to share cells out by.
double relative_cost(const Problem& problem, int cell);

}  // namespace tunica::full3d
