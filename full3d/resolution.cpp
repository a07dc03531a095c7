// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/resolution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "core/coupled/loading.hpp"
#include "core/coupled/wall_strain.hpp"
#include "core/element/grading.hpp"
#include "core/error.hpp"
#include "core/wall/from_scene.hpp"

namespace tunica::full3d {

namespace {

using coupled::corner_grading;
using coupled::interface_grading;

/// The fewest cells along a torus, from `cells` on, of which none turns by more than 45 degrees.
int cells_along_bend(const Scene& scene, int cells) {
  const double grading = coupled::end_grading(scene), length = scene.number("geometry.length");
  if (grading > element::steepest_grading) return cells;
  const double longest = 45 / scene.number("geometry.bend_angle") * length;
  for (;; cells += 2) {
    const auto lines = element::lines_along(length, cells, grading);
    if (lines[cells / 2] - lines[cells / 2 - 1] <= longest) return cells;
  }
}

}  // namespace

Resolution resolution(const Scene& scene) {
  Resolution r{coupled::cell_counts(scene)};
  if (scene.text("geometry.kind") == "torus") r.axial_cells = cells_along_bend(scene, r.axial_cells);
  r.around_cells = 8 * coupled::cells_as_along(scene, 1);
  coupled::take_given(scene, r);
  if (scene.has("mesh.around_cells")) r.around_cells = static_cast<int>(scene.integer("mesh.around_cells"));
  return r;
}

Sector sector_of(const Scene& scene) {
  const std::string& asked = scene.text("mesh.symmetry");
  if (asked == "full") return Sector::full;
  const auto layers = wall::wall_from_scene(SeededScene<double>(scene));
  const bool balanced = std::all_of(layers.begin(), layers.end(),
                                    [](const auto& layer) { return coupled::is_balanced(layer.law); });
  const bool bent = scene.text("geometry.kind") == "torus";
  if (asked != "auto" && !balanced)
    throw InvalidInput(fmt::format(
        "mesh.symmetry = \"{}\": the wall.families are not in balance between positive and negative "
        "angles, so that the artery is not its own mirror image; write \"full\" or \"auto\"",
        asked));
  if (asked == "quarter" && bent)
    throw InvalidInput(
        "mesh.symmetry = \"quarter\" is for straight arteries; a torus is its own mirror image about the "
        "plane of its bend alone: write \"half\" or \"auto\"");
  if (asked == "half" || (asked == "auto" && balanced && bent)) return Sector::half;
  if (asked == "quarter" || (asked == "auto" && balanced)) return Sector::quarter;
  return Sector::full;
}

VesselSpec vessel_spec(const Scene& scene, const Resolution& resolution, bool with_blood) {
  VesselSpec spec;
  spec.radius = scene.number("geometry.radius");
  const double thickness = scene.number("geometry.thickness");
  const std::size_t layers = scene.count("wall.layers");
  for (std::size_t i = 0; i < layers; ++i)
    spec.layers.push_back(thickness * scene.number(fmt::format("wall.layers[{}].fraction", i)));
  if (layers == 0) spec.layers.push_back(thickness);
  spec.length = scene.number("geometry.length");
  if (scene.text("geometry.kind") == "torus")
    spec.bend_angle = scene.number("geometry.bend_angle") * std::numbers::pi / 180;
  spec.around_cells = resolution.around_cells;
  spec.ring_cells = resolution.blood_cells;
  spec.wall_cells = resolution.wall_cells;
  spec.axial_cells = resolution.axial_cells;
  spec.sector = sector_of(scene);
  spec.blood = with_blood;
  spec.wall_grading = coupled::relative_thickness(scene);
  spec.quadratic = scene.text("mesh.element") == "quadratic";
  if (scene.text("geometry.ends") == "clamped") {
    const double bending = element::bending_layer_grading(spec.radius, thickness, spec.length);
    if (corner_grading * bending > element::steepest_grading)
      throw InvalidInput(
          fmt::format("geometry.length = {:g} cm is {:.3g} times geometry.radius, too long for a mesh that "
                      "also resolves how the clamped ends bend the wall; shorten it",
                      spec.length, spec.length / spec.radius));
    spec.end_grading = coupled::end_grading(scene);
    spec.interface_grading = spec.quadratic ? interface_grading : 1;
  }
  const bool tetrahedra = scene.text("mesh.element") == "bubble" || scene.text("mesh.cell") == "triangle";
  spec.shape = tetrahedra ? Shape::tetrahedron : Shape::hexahedron;
  return spec;
}

SolverChoice solver_of(const Scene& scene) {
  return {scene.text("solver.method"), scene.has("solver.options") ? scene.text("solver.options") : ""};
}

}  // namespace tunica::full3d
