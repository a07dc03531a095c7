// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/observables/field_series.hpp"

namespace tunica::report {

/// What can be seen of a body of tetrahedra or hexahedra: its surface, and its section along a plane y =
/// const of the unloaded body. Both move with the body, so that they stand for all times.
struct Surface {
  /// Where values are taken: (1 - weight) of the first and weight of the second point of the mesh.
  struct Place {
    int first, second;
    double weight;
  };
  using Triangle = std::array<int, 3>;  ///< of vertices
  std::vector<Place> places;
  /// The place of each vertex. Where the surface has an edge, its place is there once for each side, so that
  /// each has its own normal.
  std::vector<int> vertices;
  std::vector<Triangle> outer;    ///< counterclockwise seen from outside
  std::vector<Triangle> section;  ///< counterclockwise seen from larger y
};

/// Corners of the faces that belong to one cell only, counterclockwise seen from outside; the last is -1 for
/// a triangle. Points that coincide count as one, so that faces between cells that share no points are none.
/// Faces in a plane of symmetry are left out: the whole body has cells behind them.
std::vector<std::array<int, 4>> boundary_faces(const observables::FieldMesh& mesh);

/// The surface, and the section at y = cut: of two cells that meet there, that with the larger y is shown,
/// or, when nothing lies at larger y, the other.
Surface visible_surface(const observables::FieldMesh& mesh, double cut);

/// A field's numbers at the places, component after component for each place. NaN where a point has none.
std::vector<float> at_places(const Surface& surface, const std::vector<float>& values,
                             std::size_t components);

}  // namespace tunica::report
