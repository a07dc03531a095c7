// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

#include "core/kernel/contract.hpp"
#include "core/physics/surface.hpp"

namespace tunica::kernel {

/// Shape functions and weight at a quadrature point of a side; lifts 1 to `dimension` hold derivatives along
/// the surface.
template <class Frame, int Width>
struct SidePoint {
  double weight = 0;  ///< reference area
  std::array<double, Frame::dimension> place{};
  Vector<double> normal{};  ///< outward from the side's cell, unit, reference
  Lifted<Frame, Width> shapes;
};

template <class Frame, int Width>
struct SideNodes {
  NodalVector<Frame, Width> displacement, velocity, mesh_velocity;
  double pressure = 0;  ///< uniform on the boundary
};

/// What loads on a surface may depend on.
template <class S>
struct SurfaceState {
  Vector<S> displacement, velocity, mesh_velocity;
  Tensor<S> gradient;  ///< of the displacement, along the surface
  S pressure;
};

/// A load tested with phi, and the flow through the surface.
template <class S>
struct SurfaceTerms {
  Vector<S> load{S(0.0), S(0.0), S(0.0)};
  S flow{0.0};
};

template <class Frame, int Width>
struct SideResidual {
  NodalVector<Frame, Width> momentum;
  double flow = 0;     ///< out through the side
  double leaving = 0;  ///< of it, where it goes outwards
};

template <class Frame, int Width>
struct SideTangent {
  static constexpr int n = Frame::components;
  Block<Width> momentum_velocity[n][n], momentum_displacement[n][n];
  NodalVector<Frame, Width> momentum_pressure, flow_velocity, flow_displacement;
};

namespace detail {

template <class Frame, int Width>
SurfaceState<double> surface_state(const SidePoint<Frame, Width>& at, const SideNodes<Frame, Width>& nodes) {
  return {field_value(at.shapes, nodes.displacement), field_value(at.shapes, nodes.velocity),
          field_value(at.shapes, nodes.mesh_velocity), field_gradient(at.shapes, nodes.displacement),
          nodes.pressure};
}

}  // namespace detail

/// `terms` is a callable on (SurfaceState<S>, normal) that gives SurfaceTerms<S> for doubles and duals.
template <class Frame, int Width, class Terms>
void add_side_residual(const Terms& terms, const SidePoint<Frame, Width>& at,
                       const SideNodes<Frame, Width>& nodes, SideResidual<Frame, Width>& residual) {
  const SurfaceTerms<double> values = terms(detail::surface_state(at, nodes), at.normal);
  test_vector(at.weight, values.load, Tensor<double>{}, at.shapes, residual.momentum);
  residual.flow += at.weight * values.flow;
  residual.leaving += at.weight * std::max(values.flow, 0.0);
}

/// Adds the derivatives of the residual along directions, each given by the nodal values that change with it.
template <std::size_t Directions, class Frame, int Width, class Terms>
void add_side_change(const Terms& terms, const SidePoint<Frame, Width>& at,
                     const SideNodes<Frame, Width>& nodes,
                     const std::array<SideNodes<Frame, Width>, Directions>& along,
                     std::array<SideResidual<Frame, Width>, Directions>& change) {
  using D = Dual<double, static_cast<int>(Directions)>;
  const auto plain_state = detail::surface_state(at, nodes);
  SurfaceState<D> state;
  for (int i = 0; i < 3; ++i) {
    state.displacement[i] = D(plain_state.displacement[i]);
    state.velocity[i] = D(plain_state.velocity[i]);
    state.mesh_velocity[i] = D(plain_state.mesh_velocity[i]);
  }
  state.gradient = lift<D>(plain_state.gradient);
  state.pressure = D(plain_state.pressure);
  for (std::size_t k = 0; k < Directions; ++k) {
    const auto moved = detail::surface_state(at, along[k]);
    for (int i = 0; i < 3; ++i) {
      state.displacement[i].derivative[k] = moved.displacement[i];
      state.velocity[i].derivative[k] = moved.velocity[i];
      state.mesh_velocity[i].derivative[k] = moved.mesh_velocity[i];
    }
    for (int e = 0; e < 9; ++e) state.gradient.entries[e].derivative[k] = moved.gradient.entries[e];
    state.pressure.derivative[k] = moved.pressure;
  }
  const SurfaceTerms<D> values = terms(state, at.normal);
  for (std::size_t k = 0; k < Directions; ++k) {
    Vector<double> load;
    for (int i = 0; i < 3; ++i) load[i] = values.load[i].derivative[k];
    test_vector(at.weight, load, Tensor<double>{}, at.shapes, change[k].momentum);
    change[k].flow += at.weight * values.flow.derivative[k];
  }
}

template <class Frame, int Width, class Terms>
void add_side_tangent(const Terms& terms, double rate_coefficient, const SidePoint<Frame, Width>& at,
                      const SideNodes<Frame, Width>& nodes, SideTangent<Frame, Width>& tangent) {
  constexpr int n = Frame::components, g = gradient_size<Frame>;
  constexpr int velocity = 0, displacement = n, pressure = 2 * n + g, inputs = pressure + 1;
  using D = Dual<double, inputs>;
  const auto plain_state = detail::surface_state(at, nodes);
  SurfaceState<D> state;
  state.velocity = seed_vector<Frame, inputs>(plain_state.velocity, velocity);
  state.displacement = seed_vector<Frame, inputs>(plain_state.displacement, displacement);
  state.mesh_velocity = seed_vector<Frame, inputs>(plain_state.mesh_velocity, displacement, rate_coefficient);
  state.gradient = seed_gradient<Frame, inputs>(plain_state.gradient, displacement + n);
  state.pressure = D::variable(plain_state.pressure, pressure);
  const SurfaceTerms<D> values = terms(state, at.normal);

  constexpr auto vectors = vector_slots<Frame>();
  std::array<Slot, n> value_slots{};
  for (int c = 0; c < n; ++c) value_slots[c] = {c, 0};
  const auto load = [&](int from) {
    return [&, from](int out, int in) { return values.load[Frame::axes[out]].derivative[from + in]; };
  };
  contract(at.weight, value_slots, value_slots, load(velocity), at.shapes, at.shapes,
           tangent.momentum_velocity);
  contract(at.weight, value_slots, vectors, load(displacement), at.shapes, at.shapes,
           tangent.momentum_displacement);
  for (int c = 0; c < n; ++c) {
    const double by_pressure = at.weight * values.load[Frame::axes[c]].derivative[pressure];
    const double by_velocity = at.weight * values.flow.derivative[velocity + c];
    for (int k = 0; k < Width; ++k) {
      tangent.momentum_pressure.value[c][k] += by_pressure * at.shapes.lift[0][k];
      tangent.flow_velocity.value[c][k] += by_velocity * at.shapes.lift[0][k];
    }
  }
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    const double factor = at.weight * values.flow.derivative[displacement + i];
    for (int k = 0; k < Width; ++k)
      tangent.flow_displacement.value[vectors[i].component][k] += factor * at.shapes.lift[vectors[i].lift][k];
  }
}

}  // namespace tunica::kernel
