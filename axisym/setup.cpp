// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/setup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "axisym/locate.hpp"
#include "core/error.hpp"
#include "core/radial/compressible_ring.hpp"
#include "core/radial/from_scene.hpp"
#include "core/radial/wall_curve.hpp"
#include "core/wall/from_scene.hpp"

namespace tunica::axisym {

namespace {

Element element_from(const std::string& name) {
  if (name == "linear") return Element::linear;
  if (name == "bubble") return Element::bubble;
  return Element::quadratic;
}

void set_ends(const Scene& scene, Problem& problem) {
  const bool clamped = scene.text("geometry.ends") == "clamped";
  for (const Boundary boundary :
       {Boundary::inlet, Boundary::outlet, Boundary::wall_inlet, Boundary::wall_outlet})
    problem.on(boundary).displacement = {clamped, true};
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
  problem.inlet.value = [here](double time) { return here->inlet_value(time); };
  if (setup.inlet.is_pressure) {
    problem.inlet.kind = InletKind::pressure;
    return;
  }
  if (scene.text("inlet.profile") == "natural") {
    problem.inlet.kind = InletKind::flow;
    return;
  }
  if (scene.text("geometry.ends") == "sliding")
    throw InvalidInput(
        "inlet.profile = \"parabolic\" prescribes velocities on a section of fixed radius, which "
        "geometry.ends = "
        "\"sliding\" lets widen; write inlet.profile = \"natural\"");
  problem.inlet.kind = InletKind::prescribed;
  problem.on(Boundary::inlet).velocity = {true, true};
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

void set_outlet(const Scene& scene, Setup& setup) {
  OutletCondition& outlet = setup.problem.outlet;
  outlet.resistance = scene.number("outlet.resistance");
  const double beyond = scene.number("outlet.pressure");
  const Setup* const here = &setup;
  // From rest all loads grow together: a pressure beyond the outlet that is there at once would be a blow.
  outlet.pressure = [here, beyond](double time) { return here->load * beyond * here->inlet.growth_at(time); };
  outlet.backflow = scene.number("outlet.backflow");
  if (scene.text("outlet.kind") != "rcr") return;
  if (outlet.resistance == 0)
    throw InvalidInput(
        "outlet.resistance = 0 with outlet.kind = \"rcr\" shorts its compliance; set it above 0");
  outlet.kind = OutletKind::windkessel;
  outlet.proximal_resistance = scene.number("outlet.proximal_resistance");
  outlet.compliance = scene.number("outlet.compliance");
}

/// Fibres that are not in balance between +beta and -beta twist the wall, which this frame cannot follow.
void require_balance(const std::vector<wall::Law<double>>& laws) {
  constexpr double rounding = 1e-9;
  for (const auto& law : laws) {
    const auto& families = wall::families(law);
    for (const auto& family : families) {
      // Along the circumference and along the axis a family is its own mirror image.
      if (std::abs(std::sin(2 * family.angle)) < rounding) continue;
      double balance = 0;
      for (const auto& other : families)
        if (std::abs(std::abs(other.angle) - std::abs(family.angle)) < rounding &&
            other.activation_squared == family.activation_squared && other.stiffness == family.stiffness &&
            other.stiffening == family.stiffening)
          balance += std::copysign(other.weight, other.angle);
      if (std::abs(balance) > rounding * family.weight)
        throw InvalidInput(
            "wall.families are not in balance between positive and negative angles, so that the artery "
            "twists; "
            "this tier has no swirl: give each family its mirror image of equal weight, or use a 3D tier");
    }
  }
}

/// The ring of the wall that a section cuts.
std::unique_ptr<const radial::RingModel> ring_at(const Scene& scene, const Section& section) {
  auto model = radial::ring_model(scene, {});
  if (scene.text("geometry.kind") != "mesh") return model;
  radial::Ring<double> ring = model->ring();
  ring.inner_radius = section.inner;
  ring.thickness = section.outer - section.inner;
  return std::make_unique<radial::CompressibleRing>(std::move(ring),
                                                    std::vector<radial::RingModel::Seeded>{});
}

void estimate_sizes(const Scene& scene, Setup& setup, const Section& section) {
  const double inlet = std::abs(setup.inlet_scale) * setup.inlet.greatest_shape();
  const double area = std::numbers::pi * setup.lumen_radius * setup.lumen_radius;
  if (setup.inlet.is_pressure) {
    setup.expected_pressure = inlet;
  } else {
    double resistance = scene.number("outlet.resistance");
    if (scene.text("outlet.kind") == "rcr") resistance += scene.number("outlet.proximal_resistance");
    setup.expected_pressure = std::abs(scene.number("outlet.pressure")) + resistance * inlet;
    setup.expected.velocity = 2 * inlet / area;
  }
  setup.expected.pressure = setup.expected_pressure;
  if (!setup.ring || setup.expected_pressure <= 0) return;
  // A quarter of the pressure is carried even by walls that give way at the whole of it.
  try {
    const radial::WallCurve curve(ring_at(scene, section), {0.0});
    setup.expected.displacement = (curve.stretch_at(0.25 * setup.expected_pressure) - 1) * setup.lumen_radius;
  } catch (const SolverFailure&) {
    // The sizes that the run sees will do.
  }
}

}  // namespace

std::unique_ptr<Setup> setup_of(const Scene& scene) {
  return setup_of(scene, resolution(scene));
}

std::unique_ptr<Setup> setup_of(const Scene& scene, const Resolution& resolution) {
  auto setup = std::make_unique<Setup>();
  setup->inlet = inlet_from_scene(scene);
  setup->inlet_scale = setup->inlet.scale_key.empty() ? 1.0 : scene.number(setup->inlet.scale_key);
  setup->resolution = resolution;
  const bool is_static = scene.text("time.mode") == "static";
  if (is_static) setup->inlet.ramp = 0;
  // Blood at rest under pressure does nothing but press on the wall.
  const bool with_blood = !(is_static && setup->inlet.is_pressure);

  Problem& problem = setup->problem;
  problem.mesh = mesh_of(scene, setup->resolution, with_blood);
  problem.discretisation = {element_from(scene.text("mesh.element")), scene.flag("mesh.mixed_wall"),
                            scene.text("mesh.motion") == "stiffened"};
  problem.blood = {scene.number("blood.density"), scene.number("blood.viscosity")};
  for (const auto& layer : wall::wall_from_scene(SeededScene<double>(scene)))
    problem.laws.push_back(layer.law);
  if (problem.mesh.has(Part::wall) && problem.mesh.layers() != static_cast<int>(problem.laws.size()))
    throw InvalidInput(fmt::format(
        "geometry.file has {} layer{} of the wall, the scene describes {}; give each layer of the mesh its "
        "[[wall.layers]], and no more",
        problem.mesh.layers(), problem.mesh.layers() == 1 ? "" : "s", problem.laws.size()));
  require_balance(problem.laws);
  problem.wall_density = scene.number("wall.density");
  const auto ring = radial::ring_from_scene(SeededScene<double>(scene));
  problem.tether = {ring.tether_stiffness, ring.traction};
  set_ends(scene, problem);

  const Extent ends = extent(problem.mesh);
  const Section middle = section_at(problem.mesh, 0.5 * (ends.inlet + ends.outlet));
  setup->lumen_radius = middle.inner;
  if (problem.mesh.has(Part::wall))
    setup->ring = ring_at(scene, middle);
  else
    problem.on(Boundary::interface).displacement = {true, true};
  if (problem.mesh.has(Part::blood)) {
    set_inlet(scene, *setup);
    set_outlet(scene, *setup);
  } else {
    if (!setup->inlet.is_pressure)
      throw InvalidInput(
          "geometry.file has a wall without blood, which takes a pressure and no flow; write inlet.waveform "
          "= "
          "\"pressure\", \"pulse\" or a .csv file with a pressure");
    const Setup* const here = setup.get();
    problem.lumen_pressure = [here](double time) { return here->inlet_value(time); };
  }
  estimate_sizes(scene, *setup, middle);
  return setup;
}

}  // namespace tunica::axisym
