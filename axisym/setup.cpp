// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/setup.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "axisym/locate.hpp"
#include "axisym/mesh_check.hpp"
#include "core/coupled/gmsh_parts.hpp"
#include "core/coupled/wall_strain.hpp"
#include "core/error.hpp"
#include "core/radial/from_scene.hpp"

namespace tunica::axisym {

namespace {

void set_ends(const Scene& scene, Problem& problem) {
  const bool clamped = scene.text("geometry.ends") == "clamped";
  for (const Boundary boundary :
       {Boundary::inlet, Boundary::outlet, Boundary::wall_inlet, Boundary::wall_outlet})
    problem.on(boundary).displacement = {clamped, true};
  if (!clamped)
    for (const Boundary boundary :
         {Boundary::inlet, Boundary::outlet, Boundary::wall_inlet, Boundary::wall_outlet})
      coupled::check_sliding(boundary, inclination(problem.mesh, boundary),
                             scene.number("accuracy.tolerance"));
  // Blood comes in along the axis (paper, 2.3). Where it may also come in from the side, its momentum makes
  // the pressure condition unstable. A section that is free to widen stands for one within a longer artery.
  problem.on(Boundary::inlet).velocity[0] = true;
  if (!clamped) problem.on(Boundary::outlet).velocity[0] = true;
}

/// Flow of the parabola 1 - (r/R)^2 as the element interpolates it at the inlet: the exact pi R^2/2 for
/// quadratic elements, less for linear ones, whose flow would otherwise be wrong.
double parabola_flux(const Problem& problem, double radius) {
  if (problem.discretisation.element == Element::quadratic) return 0.5 * std::numbers::pi * radius * radius;
  double flux = 0;
  for (const Edge& edge : problem.mesh.edges) {
    if (edge.boundary != Boundary::inlet) continue;
    const auto nodes = problem.mesh.side_nodes(edge.cell, edge.side);
    const double a = problem.mesh.points[nodes[0]][0], b = problem.mesh.points[nodes[1]][0];
    const double u = 1 - (a / radius) * (a / radius), v = 1 - (b / radius) * (b / radius);
    flux += std::numbers::pi / 3 * std::abs(b - a) * (a * (2 * u + v) + b * (u + 2 * v));
  }
  return flux;
}

void set_inlet(const Scene& scene, Setup& setup) {
  Problem& problem = setup.problem;
  const Setup* const here = &setup;
  if (!coupled::needs_profile(scene, setup, problem.inlet)) return;
  problem.on(Boundary::inlet).velocity = {true, true};
  check_plane(problem.mesh, Boundary::inlet, "geometry.file with inlet.profile = \"parabolic\"");
  const double radius = inlet_radius(problem.mesh);
  const double height = extent(problem.mesh).inlet;
  const double peak = 1 / parabola_flux(problem, radius);
  problem.velocity = [here, radius, height, peak](const Point& place, double time) -> Vector<double> {
    // Nodes of a mesh from a file lie on the inlet's plane to rounding only.
    if (std::abs(place[1] - height) > 1e-5 * radius) return {};
    const double share = place[0] / radius;
    return {0, 0, here->inlet_value(time) * peak * (1 - share * share)};
  };
}

/// Fibres that are not in balance between +beta and -beta twist the wall, which this frame cannot follow.
void require_balance(const std::vector<wall::Law<double>>& laws) {
  if (std::all_of(laws.begin(), laws.end(), coupled::is_balanced)) return;
  throw InvalidInput(
      "wall.families are not in balance between positive and negative angles, so that the artery twists; "
      "this tier has no swirl: give each family its mirror image of equal weight, or use --tier full3d");
}

coupled::Tube tube_of(const Scene& scene, const Problem& problem, const Extent& ends) {
  const double thickness = problem.mesh.has(Part::wall) ? scene.number("geometry.thickness") : 0;
  return {scene.number("geometry.radius"), thickness, ends.length(), scene.text("geometry.ends") == "clamped",
          [&mesh = problem.mesh, begin = ends.inlet](int node) -> coupled::Tube::Place {
            return {mesh.points[node][1] - begin, mesh.points[node][0], {1, 0, 0}, {0, 1, 0}};
          }};
}

/// The ring of the wall that a section cuts.
std::unique_ptr<const radial::RingModel> ring_at(const Scene& scene, const Section& section) {
  if (scene.text("geometry.kind") != "mesh") return radial::ring_model(scene, {});
  return coupled::ring_of(scene, section.inner, section.outer - section.inner);
}

}  // namespace

std::unique_ptr<Setup> setup_of(const Scene& scene) {
  return setup_of(scene, resolution(scene));
}

std::unique_ptr<Setup> setup_of(const Scene& scene, const Resolution& resolution) {
  auto setup = conditions_of(scene, resolution);
  const Problem& problem = setup->problem;
  std::unique_ptr<const radial::RingModel> ring;
  if (problem.mesh.has(Part::wall)) {
    const Extent ends = extent(problem.mesh);
    const Section middle = section_at(problem.mesh, 0.5 * (ends.inlet + ends.outlet));
    setup->ring = ring_at(scene, middle);
    ring = ring_at(scene, middle);
  }
  coupled::estimate_sizes(scene, std::move(ring), *setup);
  coupled::set_steady_state(problem, problem.mesh.has(Part::blood), *setup);
  return setup;
}

std::unique_ptr<Setup> conditions_of(const Scene& scene, const Resolution& resolution) {
  auto setup = std::make_unique<Setup>();
  coupled::set_source(scene, *setup);
  setup->resolution = resolution;
  const bool with_blood = coupled::needs_blood(scene, *setup);

  Problem& problem = setup->problem;
  problem.mesh = mesh_of(scene, setup->resolution, with_blood);
  coupled::set_conditions(scene, *setup, problem);
  if (problem.mesh.has(Part::wall)) coupled::check_layers(problem.mesh.layers(), problem.laws.size());
  require_balance(problem.laws);
  setup->wall_density = problem.wall_density;
  set_ends(scene, problem);
  // A single cell across the blood does not show how the motion of sections falls off the wall.
  const bool resolves_sections = has_sections(scene) && setup->resolution.blood_cells > 1;
  problem.discretisation.motion =
      coupled::mesh_motion_of(scene, problem.mesh.has(Part::blood) && resolves_sections);

  const Extent ends = extent(problem.mesh);
  setup->lumen_radius = section_at(problem.mesh, 0.5 * (ends.inlet + ends.outlet)).inner;
  if (!problem.mesh.has(Part::wall)) problem.on(Boundary::interface).displacement = {true, true};
  if (problem.mesh.has(Part::blood)) {
    set_inlet(scene, *setup);
  } else {
    coupled::require_pressure(setup->inlet.is_pressure);
    const Setup* const here = setup.get();
    problem.lumen_pressure = [here](double time) { return here->inlet_value(time); };
  }
  if (scene.text("geometry.kind") != "mesh") setup->tube = tube_of(scene, problem, ends);
  return setup;
}

}  // namespace tunica::axisym
