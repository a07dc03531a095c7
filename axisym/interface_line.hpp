// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "axisym/wall_state.hpp"

namespace tunica::axisym {

/// What is seen along the inner surface of the wall.
struct InterfaceState {
  double z, radius;            ///< current, cm
  double radial_displacement;  ///< cm
  double pressure;             ///< of blood at the wall, or that on a wall alone, dyn/cm2
  double wall_shear_stress;    ///< dyn/cm2; NaN without blood
  double von_mises;            ///< dyn/cm2; NaN without a wall
};

/// The nodes of the interface, by height and then radius in the unloaded vessel.
class InterfaceLine {
 public:
  explicit InterfaceLine(const WallReader& reader);

  /// Wall shear stress is the tangential part of the traction that blood exerts on the wall, positive
  /// downstream: -t.(sigma n) with the outward normal n of the blood and the tangent t from the inlet to the
  /// outlet, of the current surface. Velocity gradients, and strain in the innermost layer, are means over
  /// the cells that meet at a node; between two straight or parabolic sides the tangent is the mean of
  /// theirs.
  std::vector<InterfaceState> states(double time, std::span<const double> y) const;

 private:
  /// A side with the node on it: its place among the side's nodes as Mesh::side_nodes gives them.
  struct SideAt {
    std::array<int, 3> nodes;
    int at;
  };
  struct Node {
    int node;
    std::vector<Place> blood, wall;
    std::vector<SideAt> sides;          ///< of blood
    std::vector<int> pressure_corners;  ///< whose pressures' mean is that at the node
  };
  double shear_stress(const Node& node, std::span<const double> y) const;
  std::array<double, 2> tangent(const Node& node, std::span<const double> y) const;

  const WallReader& reader_;
  std::vector<Node> nodes_;
};

}  // namespace tunica::axisym
