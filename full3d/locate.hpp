// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "full3d/mesh.hpp"

namespace tunica::full3d {

/// A point of a mesh.
struct Place {
  int cell;
  element::solid::Local local;
};

/// Finds points in a mesh, which must outlive it.
class Locator {
 public:
  explicit Locator(const Mesh& mesh);

  /// The place of a point in a part, nothing if it lies outside. Newton's method on the cells' maps; a point
  /// counts as inside to 1e-9 of the cell's size, and then its local coordinates are in the closed reference
  /// cell. Of the cells that share a boundary point the one of the lowest index is taken.
  std::optional<Place> find(const Point& point, Part part) const;

  /// The cells of the place's part that meet there, sorted, with the place in each of them: several where it
  /// lies on a face, on an edge or at a corner (to 1e-7 of the local coordinates).
  std::vector<Place> meeting(const Place& place) const;

 private:
  struct Box {
    Point low, high;
    double size() const;
    void include(const Point& point);
    bool contains(const Point& point) const;  ///< to the tolerance
  };
  Box bounding_box(int cell) const;
  int bin(const Point& point, int direction) const;
  std::optional<element::solid::Local> invert(int cell, const Point& point,
                                              const element::solid::Local& start) const;

  const Mesh& mesh_;
  std::vector<Box> boxes_;  ///< of the cells
  /// Bins of equal boxes that cover the mesh, and the cells whose boxes reach into each.
  Box whole_{};
  std::array<int, 3> bins_{};
  std::vector<int> first_in_bin_, in_bin_;
  std::vector<int> first_at_node_, at_node_;  ///< cells around each corner node
};

}  // namespace tunica::full3d
