// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/coupled/conditions.hpp"
#include "core/coupled/equations.hpp"
#include "core/kernel/surface_side.hpp"
#include "core/physics/surface.hpp"

/// Loads on the boundaries of a vessel, and the scalar equations of its inlet and outlet.
namespace tunica::coupled {

/// Loads on a boundary of the vessel and the flow through it, for kernel::add_side_residual and its tangent.
template <int dimension>
struct BoundaryTerms {
  const Conditions<dimension>& conditions;
  Boundary boundary;

  template <class S>
  kernel::SurfaceTerms<S> operator()(const kernel::SurfaceState<S>& state,
                                     const Vector<double>& normal) const {
    kernel::SurfaceTerms<S> terms;
    if (boundary == Boundary::outer) {
      terms.load = physics::tether_load(conditions.tether, state.displacement, state.gradient, normal);
      return terms;
    }
    const Vector<S> area = physics::oriented_area(state.gradient, normal);
    terms.load = physics::pressure_load(state.pressure, area);
    if (boundary == Boundary::interface) return terms;
    terms.flow = physics::flow_density(state.velocity, state.mesh_velocity, area);
    const double beta = boundary == Boundary::outlet  ? conditions.outlet.backflow
                        : boundary == Boundary::inlet ? conditions.inlet.backflow
                                                      : 0;
    if (beta == 0) return terms;
    const auto back = physics::backflow_load(beta, conditions.blood.density, terms.flow, state.velocity);
    for (int i = 0; i < 3; ++i) terms.load[i] = terms.load[i] + back[i];
    return terms;
  }
};

/// True where BoundaryTerms has something to do: `alone` for the surface of a wall without blood.
template <int dimension>
bool is_loaded(const Conditions<dimension>& conditions, Boundary boundary, bool alone) {
  switch (boundary) {
    case Boundary::inlet:
      return conditions.inlet.kind != InletKind::prescribed;
    case Boundary::outlet:
      return conditions.outlet.kind != OutletKind::prescribed;
    case Boundary::outer:
      return conditions.tether.stiffness > 0;
    case Boundary::interface:
      return alone;
    default:
      return false;
  }
}

/// Entry of y that holds the pressure on a boundary, none when there is no such unknown.
std::optional<std::size_t> pressure_entry(const Layout& layout, Boundary boundary);

/// Scalar equations that the flow out through a boundary enters.
struct ScalarRow {
  std::size_t entry;  ///< of y
  double factor;      ///< on the flow out of what is meshed
};
std::vector<ScalarRow> scalar_rows(const Layout& layout, const OutletCondition& outlet, double copies,
                                   Boundary boundary);
template <int dimension>
std::vector<ScalarRow> scalar_rows(const Layout& layout, const Conditions<dimension>& conditions,
                                   Boundary boundary) {
  return scalar_rows(layout, conditions.outlet, conditions.copies, boundary);
}

/// Pressure on a boundary of the blood, or on the inner surface of a wall alone.
template <int dimension>
double pressure_on(const Conditions<dimension>& conditions, const Layout& layout, Boundary boundary,
                   double time, std::span<const double> y) {
  if (const auto entry = pressure_entry(layout, boundary)) return y[*entry];
  if (boundary == Boundary::inlet && conditions.inlet.kind == InletKind::pressure)
    return conditions.inlet.value(time);
  if (boundary == Boundary::interface) return conditions.lumen_pressure(time);
  return 0;
}

/// The scalar equations but for the flows: that of the inlet gives the flow, those of the outlet are
/// p = p_v + R Q, or p = p_c + R_prox Q and C dp_c/dt = Q - (p_c - p_v)/R.
void add_scalars(const InletCondition& inlet, const OutletCondition& outlet, const Layout& layout,
                 const Stage& stage, std::span<const double> y, std::span<double> residual);

/// Derivative of add_scalars along a direction in which the state, and the history of the stage, change.
void add_scalar_change(const OutletCondition& outlet, const Layout& layout, const Stage& along,
                       std::span<const double> y, std::span<double> change);

/// Their derivative: an entry of the matrix.
struct ScalarEntry {
  int row, column;
  double value;
};
std::vector<ScalarEntry> scalar_tangent(const OutletCondition& outlet, const Layout& layout,
                                        double coefficient);

/// Sets the prescribed entries, by the place of their nodes among `points`, displacements that are shares of
/// the wall's, and the wall's velocities. `axes` as a frame has them.
template <int dimension, class Points, class Axes>
void complete(const Conditions<dimension>& conditions, const Layout& layout, const Points& points,
              const Axes& axes, const Stage& stage, std::span<double> y) {
  for (const auto& entry : layout.prescribed()) {
    const auto& function = entry.is_velocity ? conditions.velocity : conditions.displacement;
    const auto value = function ? function(points[entry.node], stage.time) : Vector<double>{};
    y[entry.entry] = value[axes[entry.component]];
  }
  layout.share_out(y);
  for (const int node : layout.wall_nodes())
    for (int c = 0; c < dimension; ++c)
      y[layout.velocity(node, c)] = rate(stage, y, layout.displacement(node, c));
}

/// Scalars of the openings, for a layout.
template <int dimension>
void add_openings(const Conditions<dimension>& conditions, LayoutSpec& spec) {
  spec.inlet_pressure = conditions.inlet.kind == InletKind::flow;
  spec.outlet_pressure = conditions.outlet.kind != OutletKind::prescribed;
  spec.windkessel_pressure = conditions.outlet.kind == OutletKind::windkessel;
}

}  // namespace tunica::coupled
