// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/gmsh.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "axisym/gmsh_boundary.hpp"
#include "axisym/gmsh_cells.hpp"
#include "axisym/gmsh_file.hpp"
#include "axisym/mesh_check.hpp"
#include "core/error.hpp"
#include "core/scene/message.hpp"
#include "core/scene/text.hpp"

namespace tunica::axisym {

namespace {

/// A million cells.
constexpr std::size_t largest_mesh = 200'000'000;

}  // namespace

Mesh parse_gmsh(std::string_view text, const std::string& label) {
  if (text.find('\0') != std::string_view::npos)
    throw InvalidInput(fmt::format("{}: the mesh is binary; save it as ASCII (Mesh.Binary = 0)", label));
  const GmshFile file = parse_gmsh_file(text, label);
  GmshCells cells = gmsh_cells(file);
  check_cells(cells.mesh, label, cells.tags);
  mark_boundaries(file, cells);
  check_outline(cells.mesh, label);
  check_layers(cells.mesh, label, cells.tags);
  return std::move(cells.mesh);
}

Mesh read_gmsh(const std::filesystem::path& file) {
  const std::string text = scene::load_text(file, "mesh", ".msh", largest_mesh);
  return parse_gmsh(text, fmt::format("mesh file {}", scene::one_line(file.string(), 400)));
}

void check(const Mesh& mesh, const Expected& expected) {
  struct Unit {
    double per_cm;
    const char* text;
  };
  constexpr Unit units[] = {{10, "millimetres"}, {0.01, "metres"}, {1e4, "micrometres"}};
  constexpr double most = 50, exactly = 0.02;
  const double radius = inlet_radius(mesh), ratio = radius / expected.radius;
  const bool in_mm = std::abs(ratio / 10 - 1) < exactly;
  if (ratio <= most && ratio >= 1 / most && !in_mm) return;
  // The unit that brings the two radii closest together, if any does.
  const Unit* likely = nullptr;
  double distance = std::log(3.0);
  for (const Unit& unit : units) {
    const double off = std::abs(std::log(ratio / unit.per_cm));
    if (off >= distance) continue;
    distance = off;
    likely = &unit;
  }
  const std::string remedy =
      likely ? fmt::format("it is probably in {}: scale it by {:g} (Mesh.ScalingFactor)", likely->text,
                           1 / likely->per_cm)
             : fmt::format("meshes are in cm: scale it by {:.3g} (Mesh.ScalingFactor)", 1 / ratio);
  throw InvalidInput(
      fmt::format("{}: the radius at the inlet is {:.4g} cm, {:.4g} times geometry.radius = {:g} cm; {}, "
                  "or set geometry.radius to the radius meant",
                  expected.label, radius, ratio, expected.radius, remedy));
}

}  // namespace tunica::axisym
