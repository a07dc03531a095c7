// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/gmsh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/element/gmsh_file.hpp"
#include "core/error.hpp"
#include "full3d/gmsh_boundary.hpp"
#include "full3d/layout.hpp"
#include "full3d/mesh_check.hpp"

namespace tunica::full3d {

namespace {

void check_cells(const GmshCells& cells) {
  const DistortionMeter meter(cells.mesh);
  for (int cell = 0; cell < static_cast<int>(cells.mesh.cells.size()); ++cell)
    if (!(meter.of(cell).least_determinant > 0))
      throw InvalidInput(fmt::format(
          "{}: {} is turned inside out or folded by the nodes between its corners; remesh there with better "
          "cells (Mesh.HighOrderOptimize), or save it with Mesh.ElementOrder = 1",
          cells.label, cells.cell_name(cell)));
}

}  // namespace

Mesh parse_gmsh(std::string_view text, const std::string& label) {
  const element::GmshFile file = element::parse_gmsh_file(text, label, 3);
  GmshCells cells = gmsh_cells(file);
  mark_boundaries(file, cells);
  check_cells(cells);
  return std::move(cells.mesh);
}

Mesh read_gmsh(const std::filesystem::path& file) {
  return parse_gmsh(element::load_gmsh(file), element::gmsh_label(file));
}

Mesh adapted(const Mesh& mesh, Element element, bool with_blood) {
  Mesh result;
  result.shape = mesh.shape;
  result.quadratic = element == Element::quadratic;
  std::vector<int> cell_of(mesh.cells.size(), -1), node_of(mesh.points.size(), -1);
  for (std::size_t k = 0; k < mesh.cells.size(); ++k) {
    if (mesh.cells[k].part == Part::blood && !with_blood) continue;
    cell_of[k] = static_cast<int>(result.cells.size());
    Cell cell = mesh.cells[k];
    cell.nodes.fill(-1);
    const auto take = [&](int place) {
      const int node = mesh.cells[k].nodes[place];
      if (node_of[node] < 0) {
        node_of[node] = static_cast<int>(result.points.size());
        result.points.push_back(mesh.points[node]);
      }
      cell.nodes[place] = node_of[node];
    };
    const Basis basis = displacement_basis(element);
    for (int n = 0; n < element::solid::shape_count(mesh.shape, basis); ++n)
      take(node_place(mesh.shape, basis, n));
    if (element == Element::bubble) {
      Point centre{};
      for (int n = 0; n < 4; ++n)
        for (int i = 0; i < 3; ++i) centre[i] += 0.25 * result.points[cell.nodes[n]][i];
      cell.nodes[node_place(mesh.shape, Basis::linear_bubble, 4)] = static_cast<int>(result.points.size());
      result.points.push_back(centre);
    }
    result.cells.push_back(cell);
  }
  for (Face face : mesh.faces) {
    face.cell = cell_of[face.cell];
    if (face.cell >= 0) result.faces.push_back(face);
  }
  return result;
}

}  // namespace tunica::full3d
