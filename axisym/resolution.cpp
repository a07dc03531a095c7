// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/resolution.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "axisym/gmsh.hpp"
#include "axisym/structured.hpp"
#include "core/error.hpp"
#include "core/stability/warning.hpp"

namespace tunica::axisym {

namespace {

using coupled::corner_grading;
using coupled::interface_grading;

/// Nodes that a direct solver still copes with: some gigabytes, and seconds for a factorisation.
constexpr double most_nodes = 1e5;

void require_solvable(const Scene& scene, double nodes) {
  if (nodes <= most_nodes) return;
  const std::string advice = scene.text("geometry.kind") == "mesh"
                                 ? "take a coarser geometry.file"
                                 : "raise accuracy.tolerance, or set mesh.axial_cells, mesh.wall_cells and "
                                   "mesh.blood_cells to fewer";
  throw InvalidInput(fmt::format("the mesh has {:.3g} nodes, and this tier solves for at most {:g}; {}",
                                 nodes, most_nodes, advice));
}

/// What is left of a mesh without its blood; nodes that only the blood had stay and are used by nothing.
Mesh wall_alone(Mesh mesh) {
  if (!mesh.has(Part::wall)) return mesh;
  std::vector<int> place(mesh.cells.size(), -1);
  std::vector<Cell> cells;
  for (std::size_t k = 0; k < mesh.cells.size(); ++k) {
    if (mesh.cells[k].part != Part::wall) continue;
    place[k] = static_cast<int>(cells.size());
    cells.push_back(mesh.cells[k]);
  }
  std::erase_if(mesh.edges, [&](const Edge& edge) { return place[edge.cell] < 0; });
  for (Edge& edge : mesh.edges) edge.cell = place[edge.cell];
  mesh.cells = std::move(cells);
  return mesh;
}

}  // namespace

Resolution resolution(const Scene& scene) {
  Resolution r = coupled::cell_counts(scene);
  if (scene.text("time.mode") == "static" && stability::may_ripple(scene)) {
    // Whether a static state is stable shows where the mesh has room for ripples.
    r.wall_cells = std::max(r.wall_cells, 16);
    r.blood_cells = std::max(r.blood_cells, 4);
    r.axial_cells = std::max(r.axial_cells, 40);
  }
  coupled::take_given(scene, r);
  return r;
}

bool has_sections(const Scene& scene) {
  return scene.text("geometry.kind") != "mesh" && scene.text("mesh.element") != "bubble" &&
         scene.text("mesh.cell") == "quadrilateral";
}

Mesh mesh_of(const Scene& scene, const Resolution& resolution, bool with_blood) {
  if (scene.text("geometry.kind") == "mesh") {
    const auto file = scene.folder() / scene.text("geometry.file");
    Mesh mesh = read_gmsh(file);
    check(mesh, {scene.number("geometry.radius"), file.string()});
    require_solvable(scene, static_cast<double>(mesh.points.size()));
    if (scene.text("mesh.element") == "bubble" && mesh.shape != CellShape::triangle)
      throw InvalidInput(fmt::format(
          "{}: mesh.element = \"bubble\" needs triangles, and this mesh has quadrilaterals; mesh it with "
          "triangles, or write mesh.element = \"quadratic\"",
          file.string()));
    return with_blood ? mesh : wall_alone(std::move(mesh));
  }
  TubeSpec spec;
  spec.radius = scene.number("geometry.radius");
  const double thickness = scene.number("geometry.thickness");
  const std::size_t layers = scene.count("wall.layers");
  // Fractions count relative to their sum, which is 1 but for rounding and where one is varied by itself.
  double sum = 0;
  for (std::size_t i = 0; i < layers; ++i) {
    spec.layers.push_back(scene.number(fmt::format("wall.layers[{}].fraction", i)));
    sum += spec.layers.back();
  }
  for (double& layer : spec.layers) layer *= thickness / sum;
  if (layers == 0) spec.layers.push_back(thickness);
  spec.length = scene.number("geometry.length");
  spec.blood_cells = resolution.blood_cells;
  spec.wall_cells = resolution.wall_cells;
  spec.axial_cells = resolution.axial_cells;
  spec.blood = with_blood;
  spec.wall_grading = coupled::relative_thickness(scene);
  if (scene.text("geometry.ends") == "clamped") {
    const double bending = bending_layer_grading(spec.radius, thickness, spec.length);
    if (corner_grading * bending > steepest_grading)
      throw InvalidInput(
          fmt::format("geometry.length = {:g} cm is {:.3g} times geometry.radius, too long for a mesh that "
                      "also resolves how the clamped ends bend the wall; shorten it, or write geometry.ends "
                      "= \"sliding\" and inlet.profile = \"natural\"",
                      spec.length, spec.length / spec.radius));
    spec.end_grading = coupled::end_grading(scene);
    spec.interface_grading = scene.text("mesh.element") == "quadratic" ? interface_grading : 1;
  }
  require_solvable(scene, (2.0 * (spec.blood_cells + spec.wall_cells) + 1) * (2.0 * spec.axial_cells + 1));
  const bool triangles = scene.text("mesh.element") == "bubble" || scene.text("mesh.cell") == "triangle";
  spec.shape = triangles ? CellShape::triangle : CellShape::quadrilateral;
  return structured_tube(spec);
}

}  // namespace tunica::axisym
