// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/solid_gmsh.hpp"

#include <fmt/format.h>

#include <string>

#include "full3d/gmsh_cells.hpp"
#include "full3d/vessel_shape.hpp"

namespace tunica::test_support {

using full3d::Mesh;
using full3d::Shape;

namespace {

struct Kind {
  int cell, cell_nodes, face, face_nodes;
};
Kind kind_of(const Mesh& mesh) {
  if (mesh.shape == Shape::tetrahedron)
    return mesh.quadratic ? Kind{11, 10, triangle6, 6} : Kind{4, 4, triangle3, 3};
  return mesh.quadratic ? Kind{12, 27, quadrilateral9, 9} : Kind{5, 8, quadrilateral4, 4};
}

/// Places in Cell::nodes of a face's nodes in Gmsh's order.
std::vector<int> face_places(Shape shape, int face) {
  using element::solid::Basis;
  const auto places = element::solid::face_nodes(shape, Basis::quadratic, face);
  if (shape == Shape::hexahedron)
    return {places[0], places[2], places[8], places[6], places[1],
            places[5], places[7], places[3], places[4]};
  // The corners, then the middles between them.
  const auto corners = element::solid::face_nodes(shape, Basis::linear, face);
  constexpr int edges[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
  std::vector<int> all = corners;
  for (int k = 0; k < 3; ++k)
    for (int e = 0; e < 6; ++e) {
      const int a = corners[k], b = corners[(k + 1) % 3];
      if ((edges[e][0] == a && edges[e][1] == b) || (edges[e][0] == b && edges[e][1] == a))
        all.push_back(4 + e);
    }
  return all;
}

}  // namespace

GmshModel gmsh_model(const Mesh& mesh) {
  const Kind kind = kind_of(mesh);
  GmshModel model;
  std::vector<bool> used(mesh.points.size(), false);
  const auto add = [&](int type, const std::string& name, const full3d::Cell& cell, std::vector<int> places,
                       int count) {
    places.resize(count);
    std::vector<long> nodes;
    for (const int place : places) {
      used[cell.nodes[place]] = true;
      nodes.push_back(cell.nodes[place] + 1);
    }
    model.elements.push_back({static_cast<long>(model.elements.size()) + 1, type, name, std::move(nodes)});
  };
  const bool layered = mesh.layers() > 1;
  for (const auto& cell : mesh.cells) {
    std::string name(coupled::name(cell.part));
    if (layered && cell.part == full3d::Part::wall) name = fmt::format("wall:{}", cell.layer + 1);
    add(kind.cell, name, cell, full3d::places_of_gmsh_nodes(mesh.shape, kind.cell_nodes), kind.cell_nodes);
  }
  for (const auto& face : mesh.faces)
    if (face.boundary != full3d::Boundary::interface || !mesh.has(full3d::Part::blood))
      add(kind.face, std::string(coupled::name(face.boundary)), mesh.cells[face.cell],
          face_places(mesh.shape, face.face), kind.face_nodes);
  for (std::size_t k = 0; k < mesh.points.size(); ++k)
    if (used[k])
      model.nodes.push_back(
          {static_cast<long>(k) + 1, mesh.points[k][0], mesh.points[k][1], mesh.points[k][2]});
  return model;
}

GmshModel serendipity(GmshModel model) {
  std::vector<bool> used(model.nodes.back().tag + 1, false);
  for (auto& element : model.elements) {
    if (element.type == 12) {
      element.type = 17;
      element.nodes.resize(20);
    }
    if (element.type == quadrilateral9) {
      element.type = quadrilateral8;
      element.nodes.resize(8);
    }
    for (const long node : element.nodes) used[node] = true;
  }
  std::erase_if(model.nodes, [&](const auto& node) { return !used[node.tag]; });
  return model;
}

Mesh tapering_bend(const full3d::VesselSpec& spec, double taper, double angle) {
  Mesh mesh = full3d::o_grid_vessel(spec);
  const full3d::VesselShape bent{spec.radius, 0, spec.length, angle};
  for (auto& point : mesh.points) {
    const double scale = 1 - taper * point[2] / spec.length;
    point = bent.place({1.2 * scale * point[0], 0.85 * scale * point[1], point[2]});
  }
  return mesh;
}

}  // namespace tunica::test_support
