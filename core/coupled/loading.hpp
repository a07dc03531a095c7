// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>

#include "core/coupled/conditions.hpp"
#include "core/coupled/newton.hpp"
#include "core/inlet.hpp"
#include "core/radial/ring.hpp"
#include "core/scene/scene.hpp"

namespace tunica::coupled {

/// A straight vessel of one circular section.
struct Tube {
  /// A node in the unloaded vessel: along the centreline and from it, cm, and these directions in the
  /// components that the vessel's vectors have.
  struct Place {
    double along, radius;
    std::array<double, 3> outward, onward;
  };
  double radius = 0, thickness = 0, length = 0;  ///< of lumen and wall, cm; no thickness of a rigid pipe
  bool ends_are_held = false;
  std::function<Place(int node)> place;
};

/// Where hardly anything loads a vessel, what is less than this is at rest: the last digits of zero have no
/// accuracy that could be asked of them. Pressure in dyn/cm2 (a hundredth of a mmHg), velocity in cm/s,
/// displacement over the lumen's radius.
inline constexpr double still_pressure = 10, still_velocity = 1e-2, still_displacement = 1e-4;

/// What loads the vessel of a scene, and the sizes of what is to come of it. Stays where it was made: the
/// functions of the conditions refer to it.
struct Loading {
  Inlet inlet;
  double inlet_scale = 0;  ///< mean flow (cm3/s) or pressure (dyn/cm2)
  /// Factor on everything that loads the vessel, for static states that are approached from rest.
  double load = 1;
  /// Ring of the wall at mid-length, none when there is no wall.
  std::unique_ptr<const radial::RingModel> ring;
  double lumen_radius = 0;       ///< at mid-length, cm
  double wall_density = 0;       ///< g/cm3
  double expected_pressure = 0;  ///< greatest in the lumen, dyn/cm2, estimated from the outlet's resistance
  Newton::Sizes expected;        ///< sizes of the fields to come
  /// Pressure in the lumen at mid-length in the steady state under the full loads of a time, as far as it is
  /// known beforehand, dyn/cm2.
  std::function<double(double time)> steady_pressure;
  /// Flow through the vessel then, cm3/s.
  std::function<double(double time)> steady_flow;
  std::optional<Tube> tube;  ///< none where the vessel has another shape

  Loading() = default;
  Loading(const Loading&) = delete;
  Loading& operator=(const Loading&) = delete;
  double inlet_value(double time) const { return load * inlet_scale * inlet.shape_at(time); }
};

/// Reads the inlet. A static state has no ramp.
void set_source(const Scene& scene, Loading& loading);

/// Blood at rest under a given pressure does nothing but press on the wall: it need not be computed.
bool needs_blood(const Scene& scene, const Loading& loading);

Element element_of(const Scene& scene);

/// How the mesh in the blood moves: as the scene says, else section by section where it has sections.
MeshMotion mesh_motion_of(const Scene& scene, bool has_sections);

/// Steps in time take the mesh in the blood from the steps before (Discretisation::lagged_mesh), for a vessel
/// with such parts.
bool lags_mesh(const Scene& scene, bool with_blood, bool with_wall);

/// Sets kind and value of a scene's inlet. True when it prescribes a velocity, whose profile is the caller's
/// to give. Throws InvalidInput for a profile on a section that may widen.
bool needs_profile(const Scene& scene, const Loading& loading, InletCondition& inlet);

/// The outlet of a scene. Throws InvalidInput for an RCR model without distal resistance.
OutletCondition outlet_of(const Scene& scene, const Loading& loading);

/// The ring of a scene's wall with another radius and thickness, of a mesh from a file.
std::unique_ptr<const radial::RingModel> ring_of(const Scene& scene, double inner_radius, double thickness);

/// Sets pressures, velocities and displacements to be expected, once the lumen's radius is known. `ring` of
/// the wall at mid-length is made anew for the curve; none without a wall.
void estimate_sizes(const Scene& scene, std::unique_ptr<const radial::RingModel> ring, Loading& loading);

/// Physics, discretisation, tether and outlet of a scene.
template <int dimension>
void set_conditions(const Scene& scene, const Loading& loading, Conditions<dimension>& conditions);

/// Sets loading.steady_pressure and steady_flow. Keeps a reference to the conditions.
template <int dimension>
void set_steady_state(const Conditions<dimension>& conditions, bool with_blood, Loading& loading) {
  const Loading* const here = &loading;
  loading.steady_pressure = [&conditions, here, with_blood](double time) {
    if (!with_blood) return conditions.lumen_pressure(time);
    if (conditions.inlet.kind == InletKind::pressure) return conditions.inlet.value(time);
    const OutletCondition& outlet = conditions.outlet;
    return outlet.pressure(time) + (outlet.resistance + outlet.proximal_resistance) * here->inlet_value(time);
  };
  loading.steady_flow = [&conditions, here](double time) {
    if (conditions.inlet.kind != InletKind::pressure) return here->inlet_value(time);
    const OutletCondition& outlet = conditions.outlet;
    const double resistance = outlet.resistance + outlet.proximal_resistance;
    return resistance > 0 ? (conditions.inlet.value(time) - outlet.pressure(time)) / resistance : 0.0;
  };
}

}  // namespace tunica::coupled
