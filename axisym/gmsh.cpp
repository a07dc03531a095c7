// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/gmsh.hpp"

#include <utility>

#include "axisym/gmsh_boundary.hpp"
#include "axisym/gmsh_cells.hpp"
#include "axisym/mesh_check.hpp"
#include "core/coupled/gmsh_parts.hpp"
#include "core/element/gmsh_file.hpp"

namespace tunica::axisym {

Mesh parse_gmsh(std::string_view text, const std::string& label) {
  const GmshFile file = element::parse_gmsh_file(text, label, 2);
  GmshCells cells = gmsh_cells(file);
  check_cells(cells.mesh, label, cells.tags);
  mark_boundaries(file, cells);
  check_outline(cells.mesh, label);
  check_layers(cells.mesh, label, cells.tags);
  return std::move(cells.mesh);
}

Mesh read_gmsh(const std::filesystem::path& file) {
  return parse_gmsh(element::load_gmsh(file), element::gmsh_label(file));
}

void check(const Mesh& mesh, const coupled::Expected& expected) {
  coupled::check_unit(inlet_radius(mesh), expected);
}

}  // namespace tunica::axisym
