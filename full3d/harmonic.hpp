// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "core/tensor.hpp"
#include "full3d/mesh.hpp"

namespace tunica::full3d {

/// A value on a boundary.
struct HeldBoundary {
  Boundary boundary;
  double value;
};

/// phi with div (w grad phi) = 0 in some cells of a mesh, given on boundaries and with d(phi)/dn = 0
/// elsewhere:
///   int w grad(phi).grad(psi) dV = 0   for all psi of the basis that vanish where phi is given.
/// By node of the mesh, 0 where the basis has none. `cells` ascend; `weight` at the q-th point of
/// element::solid::cell_rule of the basis in a cell; empty for 1. Throws InvalidInput when cells hang
/// together with no boundary that phi is given on.
std::vector<double> harmonic(const Mesh& mesh, element::solid::Basis basis, std::span<const int> cells,
                             std::span<const HeldBoundary> held,
                             const std::function<double(int cell, std::size_t q)>& weight = {});

/// Gradients at a point of a cell of two functions in the basis of the cells' map, by node.
std::array<Vector<double>, 2> gradients(const Mesh& mesh, std::span<const double> first,
                                        std::span<const double> second, int cell,
                                        const element::solid::Local& local);

/// Cells of a part, ascending.
std::vector<int> cells_of(const Mesh& mesh, Part part);

}  // namespace tunica::full3d
