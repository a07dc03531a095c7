// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/kernel/blood_cell.hpp"
#include "core/kernel/surface_side.hpp"
#include "core/kernel/wall_cell.hpp"
#include "full3d/layout.hpp"

namespace tunica::full3d {

using Frame = frame::Cartesian;

/// Shape functions at a point of a cell in space.
struct PlacedShapes {
  Point place{};
  double determinant = 0;
  std::array<Point, 3> inverse{};  ///< d local_c/d place_i
  /// Derivatives by place from those by the local coordinates.
  Point slope(const element::solid::Local& local) const;
};
PlacedShapes placed(const Mesh& mesh, int cell, const element::solid::Shapes& geometry);

/// Some fibres of the law are recruited after a stretch: the stress then has a kink at a place that moves
/// through the wall.
bool has_front(const wall::Law<double>& law);

/// Makes the shape functions of cells and faces at their quadrature points when they are needed: tables of
/// all cells would take more memory than the factors of the matrix. `Width` and `SideWidth` hold the nodes
/// of a cell and of a face. Problem and mesh must outlive it.
template <int Width, int SideWidth>
class Tables {
 public:
  using BloodPoint = kernel::BloodPoint<Frame, Width>;
  using WallPoint = kernel::WallPoint<Frame, Width>;
  using SidePoint = kernel::SidePoint<Frame, SideWidth>;

  /// Throws InvalidInput for a cell whose map is not one to one.
  explicit Tables(const Problem& problem);

  void blood(int cell, std::vector<BloodPoint>& points) const;
  void wall(int cell, std::vector<WallPoint>& points) const;
  void side(const Face& face, std::vector<SidePoint>& points) const;
  /// Terms of the wall pressure that is interpolated on its own in a wall cell.
  int pressure_terms(int cell) const;
  /// Diameter of the sphere of the volume of a cell, cm.
  double size(const std::vector<BloodPoint>& points) const;
  /// Lifts of the displacement's shape functions at a local point, for observers.
  kernel::Lifted<Frame, Width> displacement_at(int cell, const element::solid::Local& local) const;

 private:
  struct Reference {
    element::solid::Shapes displacement, velocity, pressure;
    element::solid::Local local;
    double weight;
  };
  std::vector<Reference> reference(const element::solid::Rule& rule) const;
  /// Number of the rule for a wall cell: 0 the plain one, 1 + d with more points along local direction d.
  int wall_rule(int cell) const;

  /// The map at a point; that of a cell with flat sides is the same at all of them.
  PlacedShapes placed_at(int cell, const Reference& reference, bool is_first,
                         const PlacedShapes& first) const;

  const Problem& problem_;
  bool affine_ = false;
  std::vector<Reference> blood_;
  std::array<std::vector<Reference>, 4> wall_;
  std::vector<signed char> wall_rules_;  ///< by cell
  std::vector<bool> held_;               ///< by cell: it has a face whose displacement is prescribed
};

}  // namespace tunica::full3d
