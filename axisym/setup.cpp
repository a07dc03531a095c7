// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/setup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "axisym/locate.hpp"
#include "core/error.hpp"
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
  problem.velocity = [here, radius, height](const Point& place, double time) -> Vector<double> {
    if (place[1] != height) return {};
    const double share = place[0] / radius;
    const double mean = here->inlet_value(time) / (std::numbers::pi * radius * radius);
    return {0, 0, 2 * mean * (1 - share * share)};
  };
}

void set_outlet(const Scene& scene, Setup& setup) {
  OutletCondition& outlet = setup.problem.outlet;
  outlet.resistance = scene.number("outlet.resistance");
  const double beyond = scene.number("outlet.pressure");
  const Setup* const here = &setup;
  outlet.pressure = [here, beyond](double) { return here->load * beyond; };
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
  // Any one state tells: shear theta-z and theta-r of the stress under a stretch with every diagonal entry.
  const auto h = Tensor<double>::diagonal(-0.2, 0.4, 0.1);
  for (const auto& law : laws) {
    const auto stress = wall::piola(law, h, frame::Radial::axes());
    double shear = 0, size = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) (i == j ? size : shear) += std::abs(stress(i, j));
    if (shear > 1e-9 * size)
      throw InvalidInput(
          "wall.families are not in balance between positive and negative angles, so that the artery twists; "
          "this "
          "tier has no swirl: give each family its mirror image of equal weight, or use a 3D tier");
  }
}

void estimate_sizes(const Scene& scene, Setup& setup) {
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
    const radial::WallCurve curve(radial::ring_model(scene, {}), {0.0});
    setup.expected.displacement = (curve.stretch_at(0.25 * setup.expected_pressure) - 1) * setup.lumen_radius;
  } catch (const SolverFailure&) {
    // The sizes that the run sees will do.
  }
}

}  // namespace

std::unique_ptr<Setup> setup_of(const Scene& scene) {
  auto setup = std::make_unique<Setup>();
  setup->inlet = inlet_from_scene(scene);
  setup->inlet_scale = setup->inlet.scale_key.empty() ? 1.0 : scene.number(setup->inlet.scale_key);
  setup->resolution = resolution(scene);
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
  if (problem.mesh.layers() > static_cast<int>(problem.laws.size()))
    throw InvalidInput(fmt::format(
        "geometry.file has {} layers of the wall, the scene describes {}; give each a [[wall.layers]]",
        problem.mesh.layers(), problem.laws.size()));
  require_balance(problem.laws);
  problem.wall_density = scene.number("wall.density");
  const auto ring = radial::ring_from_scene(SeededScene<double>(scene));
  problem.tether = {ring.tether_stiffness, ring.traction};
  set_ends(scene, problem);

  const Extent ends = extent(problem.mesh);
  const Section middle = section_at(problem.mesh, 0.5 * (ends.inlet + ends.outlet));
  setup->lumen_radius = middle.inner;
  if (problem.mesh.has(Part::wall)) setup->ring = radial::ring_model(scene, {});
  if (problem.mesh.has(Part::blood)) {
    set_inlet(scene, *setup);
    set_outlet(scene, *setup);
  } else {
    const Setup* const here = setup.get();
    problem.lumen_pressure = [here](double time) { return here->inlet_value(time); };
  }
  estimate_sizes(scene, *setup);
  return setup;
}

}  // namespace tunica::axisym
