// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "core/coupled/mesh_extension.hpp"
#include "full3d/cell_work.hpp"
#include "full3d/petsc.hpp"

namespace tunica::full3d {

/// Moves the mesh in the blood after the wall where it is none of the unknowns. The leader's alone: the
/// system is solved once a step, with factors that are made once, and is small beside that of the step.
class MeshFollower {
 public:
  /// Of all cells. `direct`: by a factorisation (MUMPS), else by conjugate gradients with multigrid (hypre).
  MeshFollower(const Layout& layout, const CellWork& all_cells, bool direct);
  /// Throws SolverFailure when no solution was found.
  void follow(double time, std::span<double> y);

 private:
  void solve(std::span<double> right);

  const Layout& layout_;
  const CellWork& cells_;
  coupled::MeshExtension extension_;
  OwnedMatrix matrix_;  ///< on the entries of extension_
  OwnedSolver solver_;
  OwnedVector right_, solution_;
};

}  // namespace tunica::full3d
