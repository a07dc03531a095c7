// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/coupled/loading.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/error.hpp"
#include "core/radial/compressible_ring.hpp"
#include "core/radial/from_scene.hpp"
#include "core/radial/wall_curve.hpp"
#include "core/wall/from_scene.hpp"

namespace tunica::coupled {

void set_source(const Scene& scene, Loading& loading) {
  loading.inlet = inlet_from_scene(scene);
  loading.inlet_scale = loading.inlet.scale_key.empty() ? 1.0 : scene.number(loading.inlet.scale_key);
  if (scene.text("time.mode") == "static") loading.inlet.ramp = 0;
}

bool needs_blood(const Scene& scene, const Loading& loading) {
  return scene.text("time.mode") != "static" || !loading.inlet.is_pressure;
}

Element element_of(const Scene& scene) {
  const std::string& name = scene.text("mesh.element");
  if (name == "linear") return Element::linear;
  if (name == "bubble") return Element::bubble;
  return Element::quadratic;
}

MeshMotion mesh_motion_of(const Scene& scene, bool has_sections) {
  if (!scene.has("mesh.motion")) return has_sections ? MeshMotion::sectional : MeshMotion::harmonic;
  const std::string& motion = scene.text("mesh.motion");
  return motion == "sectional"   ? MeshMotion::sectional
         : motion == "stiffened" ? MeshMotion::stiffened
                                 : MeshMotion::harmonic;
}

bool lags_mesh(const Scene& scene, bool with_blood, bool with_wall) {
  return scene.text("solver.geometry") == "lagged" && scene.text("time.mode") != "static" && with_blood &&
         with_wall;
}

bool needs_profile(const Scene& scene, const Loading& loading, InletCondition& inlet) {
  const Loading* const here = &loading;
  inlet.value = [here](double time) { return here->inlet_value(time); };
  inlet.kind = loading.inlet.is_pressure                  ? InletKind::pressure
               : scene.text("inlet.profile") == "natural" ? InletKind::flow
                                                          : InletKind::prescribed;
  if (inlet.kind != InletKind::prescribed) {
    if (scene.text("inlet.pressure_kind") == "total") inlet.backflow = physics::energy_of_backflow;
    return false;
  }
  if (scene.text("geometry.ends") == "sliding")
    throw InvalidInput(
        "inlet.profile = \"parabolic\" prescribes velocities on a section of fixed radius, which "
        "geometry.ends = \"sliding\" lets widen; write inlet.profile = \"natural\"");
  return true;
}

OutletCondition outlet_of(const Scene& scene, const Loading& loading) {
  OutletCondition outlet;
  outlet.resistance = scene.number("outlet.resistance");
  const double beyond = scene.number("outlet.pressure");
  const Loading* const here = &loading;
  // From rest all loads grow together: a pressure beyond the outlet that is there at once would be a blow.
  outlet.pressure = [here, beyond](double time) { return here->load * beyond * here->inlet.growth_at(time); };
  outlet.backflow = scene.number("outlet.backflow");
  if (scene.text("outlet.kind") != "rcr") return outlet;
  if (outlet.resistance == 0)
    throw InvalidInput(
        "outlet.resistance = 0 with outlet.kind = \"rcr\" shorts its compliance; set it above 0");
  outlet.kind = OutletKind::windkessel;
  outlet.proximal_resistance = scene.number("outlet.proximal_resistance");
  outlet.compliance = scene.number("outlet.compliance");
  return outlet;
}

std::unique_ptr<const radial::RingModel> ring_of(const Scene& scene, double inner_radius, double thickness) {
  radial::Ring<double> ring = radial::ring_model(scene, {})->ring();
  ring.inner_radius = inner_radius;
  ring.thickness = thickness;
  return std::make_unique<radial::CompressibleRing>(std::move(ring),
                                                    std::vector<radial::RingModel::Seeded>{});
}

void estimate_sizes(const Scene& scene, std::unique_ptr<const radial::RingModel> ring, Loading& loading) {
  const double inlet = std::abs(loading.inlet_scale) * loading.inlet.greatest_shape();
  const double area = std::numbers::pi * loading.lumen_radius * loading.lumen_radius;
  loading.expected = {still_displacement * loading.lumen_radius, still_velocity, still_pressure};
  if (loading.inlet.is_pressure) {
    loading.expected_pressure = inlet;
  } else {
    double resistance = scene.number("outlet.resistance");
    if (scene.text("outlet.kind") == "rcr") resistance += scene.number("outlet.proximal_resistance");
    loading.expected_pressure = std::abs(scene.number("outlet.pressure")) + resistance * inlet;
    loading.expected.velocity = std::max(still_velocity, 2 * inlet / area);
  }
  loading.expected.pressure = std::max(still_pressure, loading.expected_pressure);
  if (!ring || loading.expected_pressure <= 0) return;
  // A quarter of the pressure is carried even by walls that give way at the whole of it.
  try {
    const radial::WallCurve curve(std::move(ring), {0.0});
    const double opening = (curve.stretch_at(0.25 * loading.expected_pressure) - 1) * loading.lumen_radius;
    loading.expected.displacement = std::max(loading.expected.displacement, opening);
  } catch (const SolverFailure&) {
    // The sizes that the run sees will do.
  }
}

template <int dimension>
void set_conditions(const Scene& scene, const Loading& loading, Conditions<dimension>& conditions) {
  conditions.discretisation = {element_of(scene), scene.flag("mesh.mixed_wall")};
  conditions.blood = {scene.number("blood.density"), scene.number("blood.viscosity")};
  for (const auto& layer : wall::wall_from_scene(SeededScene<double>(scene)))
    conditions.laws.push_back(layer.law);
  conditions.wall_density = scene.number("wall.density");
  const auto ring = radial::ring_from_scene(SeededScene<double>(scene));
  conditions.tether = {ring.tether_stiffness, ring.traction};
  conditions.outlet = outlet_of(scene, loading);
}
template void set_conditions(const Scene&, const Loading&, Conditions<2>&);
template void set_conditions(const Scene&, const Loading&, Conditions<3>&);

}  // namespace tunica::coupled
