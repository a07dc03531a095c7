// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>
#include <map>
#include <vector>

#include "full3d/split.hpp"

namespace tunica::test_support {

/// A channel with a wall beside it: cells of the blood in 0 < x < width, of the wall beyond, to width +
/// thickness, 0 < y < depth, 0 < z < length. The sides x = 0 and y = 0, y = depth are those of symmetry.
struct BoxSpec {
  double width, thickness, depth, length;
  int blood_cells, wall_cells, deep_cells, long_cells;
  full3d::Shape shape;
  bool quadratic;
};

/// `map` bends it; it has to leave the places of inlet and outlet, and of other sides what tests need.
inline full3d::Mesh box_mesh(const BoxSpec& spec,
                             const std::function<full3d::Point(const full3d::Point&)>& map) {
  using full3d::Boundary, full3d::Part;
  using Triple = std::array<int, 3>;
  // All nodes are on the lattice of the middles of the cells.
  const Triple most{2 * (spec.blood_cells + spec.wall_cells), 2 * spec.deep_cells, 2 * spec.long_cells};
  const int interface = 2 * spec.blood_cells;
  full3d::Mesh mesh;
  mesh.shape = spec.shape;
  mesh.quadratic = spec.quadratic;
  std::map<Triple, int> node_at;
  std::vector<Triple> lattice;
  const auto node = [&](const Triple& at) {
    const auto [found, is_new] = node_at.try_emplace(at, static_cast<int>(mesh.points.size()));
    if (is_new) {
      const double in_wall = spec.thickness * (at[0] - interface) / (most[0] - interface);
      const double x = at[0] <= interface ? spec.width * at[0] / interface : spec.width + in_wall;
      mesh.points.push_back(map({x, spec.depth * at[1] / most[1], spec.length * at[2] / most[2]}));
      lattice.push_back(at);
    }
    return found->second;
  };
  const auto add_cell = [&](const Triple& first) -> full3d::Cell& {
    full3d::Cell cell{{}, first[0] < interface ? Part::blood : Part::wall, 0};
    cell.nodes.fill(-1);
    return mesh.cells.emplace_back(cell);
  };
  const auto at = [](const Triple& first, int k) {
    return Triple{first[0] + k % 3, first[1] + k / 3 % 3, first[2] + k / 9};
  };
  const auto add_hexahedron = [&](const Triple& first) {
    full3d::Cell& cell = add_cell(first);
    for (int k = 0; k < 27; ++k) {
      const bool corner = k % 3 != 1 && k / 3 % 3 != 1 && k / 9 != 1;
      if (spec.quadratic || corner) cell.nodes[k] = node(at(first, k));
    }
  };
  // As in vessels, no tetrahedron has all corners on inlet and interface.
  const auto add_tetrahedra = [&](const Triple& first) {
    const int row = first[0] / 2 + (most[0] / 2 + 1) * (first[1] / 2), above = row + most[0] / 2 + 1;
    for (const auto& corners : full3d::split_hexahedron({row, row + 1, above, above + 1}, true)) {
      full3d::Cell& cell = add_cell(first);
      for (int k = 0; k < 4; ++k) cell.nodes[k] = node(at(first, corners[k]));
      int next = 4;
      if (spec.quadratic)
        for (int a = 0; a < 4; ++a)
          for (int b = a + 1; b < 4; ++b)
            cell.nodes[next++] = node(at(first, full3d::middle(corners[a], corners[b])));
      if (spec.quadratic || cell.part == Part::wall) continue;
      full3d::Point centre{};
      for (int k = 0; k < 4; ++k)
        for (int i = 0; i < 3; ++i) centre[i] += 0.25 * mesh.points[cell.nodes[k]][i];
      cell.nodes[10] = static_cast<int>(mesh.points.size());
      mesh.points.push_back(centre);
      lattice.push_back({-1, -1, -1});
    }
  };
  for (int k = 0; k < most[2]; k += 2)
    for (int j = 0; j < most[1]; j += 2)
      for (int i = 0; i < most[0]; i += 2)
        if (spec.shape == full3d::Shape::hexahedron)
          add_hexahedron({i, j, k});
        else
          add_tetrahedra({i, j, k});

  for (int c = 0; c < static_cast<int>(mesh.cells.size()); ++c)
    for (int face = 0; face < element::solid::faces(spec.shape); ++face) {
      const auto basis = element::solid::Basis::linear;
      const auto lies = [&](int axis, int value) {
        for (const int k : element::solid::face_nodes(spec.shape, basis, face))
          if (lattice[mesh.node(c, basis, k)][axis] != value) return false;
        return true;
      };
      const bool wall = mesh.cells[c].part == Part::wall;
      const auto add = [&](Boundary boundary) { mesh.faces.push_back({c, face, boundary}); };
      if (lies(0, 0)) add(Boundary::symmetry_x);
      if (lies(0, interface)) add(Boundary::interface);
      if (lies(0, most[0])) add(Boundary::outer);
      if (lies(1, 0) || lies(1, most[1])) add(Boundary::symmetry_y);
      if (lies(2, 0)) add(wall ? Boundary::wall_inlet : Boundary::inlet);
      if (lies(2, most[2])) add(wall ? Boundary::wall_outlet : Boundary::outlet);
    }
  return mesh;
}

}  // namespace tunica::test_support
