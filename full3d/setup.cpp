// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/setup.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/radial/from_scene.hpp"
#include "full3d/tables.hpp"

namespace tunica::full3d {

namespace {

void set_ends(const Scene& scene, const VesselShape& shape, Problem& problem) {
  const bool clamped = scene.text("geometry.ends") == "clamped";
  if (!clamped && shape.bend_angle != 0)
    throw InvalidInput(
        "geometry.ends = \"sliding\" lets the ends slide in planes across the axes, which a torus has not; "
        "write \"clamped\", or geometry.kind = \"cylinder\"");
  for (const Boundary boundary :
       {Boundary::inlet, Boundary::outlet, Boundary::wall_inlet, Boundary::wall_outlet})
    problem.on(boundary).displacement = {clamped, clamped, true};
  // Blood comes in along the axis (paper, 2.3). Where it may also come in from the side, its momentum makes
  // the pressure condition unstable. A section that is free to widen stands for one within a longer artery.
  problem.on(Boundary::inlet).velocity = {true, true, false};
  if (!clamped) problem.on(Boundary::outlet).velocity = {true, true, false};
}

double parabola(const Point& place, double radius) {
  return 1 - (place[0] * place[0] + place[1] * place[1]) / (radius * radius);
}

/// Flow of the parabola 1 - (r/R)^2 as the element interpolates it at the inlet: less than pi R^2/2, as
/// faces end within the circle.
double parabola_flux(const Problem& problem, double radius) {
  const Mesh& mesh = problem.mesh;
  const Basis basis = displacement_basis(problem.discretisation.element);
  double flux = 0;
  for (const Face& face : mesh.faces) {
    if (face.boundary != Boundary::inlet) continue;
    const auto rule = element::solid::face_rule(mesh.shape, basis, face.face);
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const auto shapes = element::solid::shapes_at(mesh.shape, basis, rule.points[q]);
      const Image at = image(mesh, face.cell, rule.points[q]);
      Vector<double> along[2] = {};
      for (int s = 0; s < 2; ++s)
        for (int i = 0; i < 3; ++i)
          for (int c = 0; c < 3; ++c) along[s][i] += at.slope[i][c] * rule.directions[s][c];
      double value = 0;
      for (int k = 0; k < shapes.count; ++k)
        value += shapes.value[k] * parabola(mesh.points[mesh.node(face.cell, basis, k)], radius);
      const Vector<double> area = cross(along[0], along[1]);
      flux += rule.weights[q] * value * std::sqrt(dot(area, area));
    }
  }
  return problem.copies * flux;
}

void set_inlet(const Scene& scene, Setup& setup) {
  Problem& problem = setup.problem;
  const Setup* const here = &setup;
  // Blood that a pressure drives in may come with any profile, and brings energy for what disturbs it:
  // without this profiles that vary around the section, which two dimensions know nothing of, grow without
  // bound.
  problem.inlet.backflow = 0.5;
  if (!coupled::needs_profile(scene, setup, problem.inlet)) return;
  problem.on(Boundary::inlet).velocity = {true, true, true};
  const double radius = setup.shape.radius, peak = 1 / parabola_flux(problem, radius);
  problem.velocity = [here, radius, peak](const Point& place, double time) -> Vector<double> {
    // The inlet lies in the plane z = 0, and nothing else of the lumen does.
    if (std::abs(place[2]) > 1e-9 * radius) return {};
    return {0, 0, here->inlet_value(time) * peak * parabola(place, radius)};
  };
}

}  // namespace

std::unique_ptr<Setup> setup_of(const Scene& scene) {
  return setup_of(scene, resolution(scene));
}

std::unique_ptr<Setup> setup_of(const Scene& scene, const Resolution& resolution) {
  auto setup = std::make_unique<Setup>();
  coupled::set_source(scene, *setup);
  setup->resolution = resolution;
  const bool with_blood = coupled::needs_blood(scene, *setup);
  const VesselSpec spec = vessel_spec(scene, resolution, with_blood);
  setup->sector = spec.sector;
  setup->shape = {spec.radius, scene.number("geometry.thickness"), spec.length, spec.bend_angle};

  Problem& problem = setup->problem;
  problem.mesh = o_grid_vessel(spec);
  const Setup* const here = setup.get();
  problem.directions = [here](const Point& place) { return here->shape.axes(place); };
  coupled::set_conditions(scene, *setup, problem);
  problem.copies = spec.sector == Sector::quarter ? 4 : spec.sector == Sector::half ? 2 : 1;
  setup->wall_density = problem.wall_density;
  set_ends(scene, setup->shape, problem);
  setup->lumen_radius = spec.radius;
  setup->ring = radial::ring_model(scene, {});
  if (with_blood)
    set_inlet(scene, *setup);
  else
    problem.lumen_pressure = [here](double time) { return here->inlet_value(time); };
  coupled::estimate_sizes(scene, radial::ring_model(scene, {}), *setup);
  coupled::set_steady_pressure(problem, with_blood, *setup);
  return setup;
}

}  // namespace tunica::full3d
