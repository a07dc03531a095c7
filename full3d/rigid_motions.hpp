// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "full3d/mesh.hpp"
#include "full3d/petsc.hpp"

namespace tunica::full3d {

/// A component of a vector at a place, as a row of the matrix.
struct PlacedComponent {
  const Point* place;
  int component;
};

/// Translations and rotations, which elasticity and viscosity do not resist: a near-null space for multigrid,
/// orthonormal, of a matrix whose rows on this rank are these.
OwnedNullSpace rigid_motions(const std::vector<PlacedComponent>& rows, MPI_Comm communicator);

}  // namespace tunica::full3d
