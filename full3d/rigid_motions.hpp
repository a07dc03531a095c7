// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "full3d/layout.hpp"
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

/// Of a state's shape, those that the prescribed displacements leave free, by unknown; independent, of any
/// length. A motion that prescribed values would have to follow by more than rounding is not free.
std::vector<std::vector<double>> free_rigid_motions(const Problem& problem, const Layout& layout,
                                                    std::span<const double> y);

}  // namespace tunica::full3d
