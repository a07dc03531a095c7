// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/resolution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/coupled/loading.hpp"
#include "core/coupled/wall_strain.hpp"
#include "core/element/grading.hpp"
#include "core/error.hpp"
#include "core/wall/from_scene.hpp"

namespace tunica::full3d {

namespace {

/// How much smaller than the bending layers need cells are at the ends, and cells at the interface than at
/// the core: as in two dimensions, where strain and pressure are singular at the clamped ends of the lumen.
constexpr double corner_grading = 16, interface_grading = 60;

/// Cells for a tolerance when an error of 1 % takes `at_one_percent`, and errors fall with the given order.
int cells(double at_one_percent, double order, double tolerance) {
  return static_cast<int>(std::ceil(at_one_percent * std::pow(0.01 / tolerance, 1 / order) - 1e-9));
}

/// Outer over inner radius; that of the paper's artery, on which the numbers of cells were found.
double thickness_ratio(const Scene& scene) {
  return 1 + scene.number("geometry.thickness") / scene.number("geometry.radius");
}
constexpr double paper_thickness_ratio = 1 + 0.01 / 0.033;

/// Of cells along the vessel: between clamped ends for how they bend the wall.
double end_grading(const Scene& scene) {
  if (scene.text("geometry.ends") != "clamped") return 1;
  const bool quadratic = scene.text("mesh.element") == "quadratic";
  return (quadratic ? corner_grading : 1) * element::bending_layer_grading(scene.number("geometry.radius"),
                                                                           scene.number("geometry.thickness"),
                                                                           scene.number("geometry.length"));
}

/// The fewest cells along a torus, from `cells` on, of which none turns by more than 45 degrees.
int cells_along_bend(const Scene& scene, int cells) {
  const double grading = end_grading(scene), length = scene.number("geometry.length");
  if (grading > element::steepest_grading) return cells;
  const double longest = 45 / scene.number("geometry.bend_angle") * length;
  for (;; cells += 2) {
    const auto lines = element::lines_along(length, cells, grading);
    if (lines[cells / 2] - lines[cells / 2 - 1] <= longest) return cells;
  }
}

}  // namespace

Resolution resolution(const Scene& scene) {
  const double tolerance = scene.number("accuracy.tolerance");
  const bool quadratic = scene.text("mesh.element") == "quadratic";
  const double finer = quadratic ? 1 : 3;
  const double across = quadratic ? 2.1 : 2, through = quadratic ? 2.6 : 2, along = quadratic ? 4.3 : 2;
  Resolution r;
  const double thick = std::max(1.0, std::log(thickness_ratio(scene)) / std::log(paper_thickness_ratio));
  r.wall_cells = cells(thick * (quadratic ? 2.4 : 6), through, tolerance);
  r.blood_cells = cells(2 * finer, across, tolerance);
  const double half_length = 0.5 * scene.number("geometry.length") / scene.number("geometry.radius");
  r.axial_cells = 2 * cells((7 + std::round(half_length / 50)) * finer, along, tolerance);
  if (scene.text("geometry.kind") == "torus") r.axial_cells = cells_along_bend(scene, r.axial_cells);
  r.around_cells = 8 * cells(finer, along, tolerance);
  const auto take = [&](const char* key, int& count) {
    if (scene.has(key)) count = static_cast<int>(scene.integer(key));
  };
  take("mesh.wall_cells", r.wall_cells);
  take("mesh.blood_cells", r.blood_cells);
  take("mesh.axial_cells", r.axial_cells);
  take("mesh.around_cells", r.around_cells);
  r.wall_cells = std::max(r.wall_cells, static_cast<int>(scene.count("wall.layers")));
  r.local_tolerance = 0.03 * tolerance;
  // Ten times less is not seen in any observable.
  r.newton_tolerance = 0.1 * r.local_tolerance;
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
        "plane of "
        "its bend alone: write \"half\" or \"auto\"");
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
  spec.wall_grading = std::max(1.0, thickness_ratio(scene) / paper_thickness_ratio);
  spec.quadratic = scene.text("mesh.element") == "quadratic";
  if (scene.text("geometry.ends") == "clamped") {
    const double bending = element::bending_layer_grading(spec.radius, thickness, spec.length);
    if (corner_grading * bending > element::steepest_grading)
      throw InvalidInput(
          fmt::format("geometry.length = {:g} cm is {:.3g} times geometry.radius, too long for a mesh that "
                      "also resolves how the clamped ends bend the wall; shorten it",
                      spec.length, spec.length / spec.radius));
    spec.end_grading = end_grading(scene);
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
