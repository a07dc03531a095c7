// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

#include "core/kernel/contract.hpp"
#include "core/physics/blood.hpp"
#include "core/physics/mesh_motion.hpp"

namespace tunica::kernel {

/// Shape functions and weight at a quadrature point of a blood cell. Velocity and mesh displacement may
/// have different bases.
template <class Frame, int Width>
struct BloodPoint {
  double weight = 0;  ///< reference volume
  std::array<double, Frame::dimension> place{};
  Lifted<Frame, Width> velocity, displacement, pressure;
};

/// Nodal values in a blood cell; rates are those that the time scheme makes of the unknowns.
template <class Frame, int Width>
struct BloodNodes {
  NodalVector<Frame, Width> velocity, acceleration, displacement, mesh_velocity;
  double pressure[Width] = {};
};

struct BloodParameters {
  physics::Blood blood;
  double rate_coefficient = 0;  ///< d(rate)/d(unknown) of the time scheme, 1/s
  double mesh_stiffness = 1;
  physics::MotionInSections sections;  ///< at the quadrature point
  /// Equal linear bases: size of the cell, cm, for the pressure stabilisation; 0 leaves it out.
  double stabilised_size = 0;
  /// Where the mesh is is given: nothing is differentiated by it.
  bool mesh_is_given = false;
};

/// Residuals of momentum, mesh motion and continuity, tested with every shape function.
template <class Frame, int Width>
struct BloodResidual {
  NodalVector<Frame, Width> momentum, mesh;
  double continuity[Width] = {};
  double least_jacobian = 1;  ///< of the mesh motion at the quadrature points
};

template <class Frame, int Width>
struct BloodTangent {
  static constexpr int n = Frame::components;
  Block<Width> momentum_velocity[n][n], momentum_displacement[n][n], momentum_pressure[n][1];
  Block<Width> mesh_displacement[n][n];
  Block<Width> continuity_velocity[1][n], continuity_displacement[1][n], continuity_pressure[1][1];
};

namespace detail {

template <class Frame, int Width>
physics::BloodState<double> blood_state(const BloodPoint<Frame, Width>& at,
                                        const BloodNodes<Frame, Width>& nodes) {
  physics::BloodState<double> state;
  state.velocity = field_value(at.velocity, nodes.velocity);
  state.velocity_gradient = field_gradient(at.velocity, nodes.velocity);
  state.acceleration = field_value(at.velocity, nodes.acceleration);
  state.pressure = interpolate(at.pressure.lift[0], nodes.pressure);
  state.mesh_velocity = field_value(at.displacement, nodes.mesh_velocity);
  state.mesh_gradient = field_gradient(at.displacement, nodes.displacement);
  return state;
}

template <class D>
physics::BloodState<D> lift(const physics::BloodState<double>& plain) {
  physics::BloodState<D> state;
  for (int i = 0; i < 3; ++i) {
    state.velocity[i] = D(plain.velocity[i]);
    state.acceleration[i] = D(plain.acceleration[i]);
    state.mesh_velocity[i] = D(plain.mesh_velocity[i]);
  }
  state.velocity_gradient = tunica::lift<D>(plain.velocity_gradient);
  state.mesh_gradient = tunica::lift<D>(plain.mesh_gradient);
  state.pressure = D(plain.pressure);
  return state;
}

template <class Frame, int Width>
Vector<double> pressure_gradient(const BloodPoint<Frame, Width>& at, const BloodNodes<Frame, Width>& nodes) {
  Vector<double> gradient{};
  for (int k = 0; k < Frame::dimension; ++k)
    gradient[Frame::axes[k]] = interpolate(at.pressure.lift[1 + k], nodes.pressure);
  return gradient;
}

template <class S>
S stabilisation(const BloodParameters& parameters, const Vector<S>& velocity) {
  return physics::stabilisation_time(parameters.blood, parameters.rate_coefficient,
                                     S(dot(velocity, velocity)), parameters.stabilised_size);
}

}  // namespace detail

template <class Frame, int Width>
void add_blood_residual(const BloodParameters& parameters, const BloodPoint<Frame, Width>& at,
                        const BloodNodes<Frame, Width>& nodes, BloodResidual<Frame, Width>& residual) {
  const auto state = detail::blood_state(at, nodes);
  const auto balance = physics::blood_balance(parameters.blood, state);
  residual.least_jacobian = std::min(residual.least_jacobian, 1 + volume_change(state.mesh_gradient));
  test_vector(at.weight, balance.force, balance.stress, at.velocity, residual.momentum);
  const auto mesh =
      physics::mesh_motion(parameters.mesh_stiffness, parameters.sections,
                           field_value(at.displacement, nodes.displacement), state.mesh_gradient);
  test_vector(at.weight, mesh.force, mesh.stress, at.displacement, residual.mesh);
  for (int k = 0; k < Width; ++k)
    residual.continuity[k] += at.weight * balance.volume_rate * at.pressure.lift[0][k];
  if (parameters.stabilised_size <= 0) return;
  const auto flux = physics::pressure_stabilisation(detail::stabilisation(parameters, state.velocity), state,
                                                    balance, detail::pressure_gradient(at, nodes));
  for (int a = 0; a < Frame::dimension; ++a)
    for (int k = 0; k < Width; ++k)
      residual.continuity[k] += at.weight * flux[Frame::axes[a]] * at.pressure.lift[1 + a][k];
}

/// Adds the derivative of the mesh's motion by the displacement, in which it is linear.
template <class Frame, int Width>
void add_mesh_tangent(double stiffness, const physics::MotionInSections& sections,
                      const BloodPoint<Frame, Width>& at,
                      Block<Width> (&blocks)[Frame::components][Frame::components]) {
  constexpr int n = Frame::components, terms = n + gradient_size<Frame>;
  constexpr auto vectors = vector_slots<Frame>();
  double derivative[terms][terms];
  for (int in = 0; in < terms; ++in) {
    Vector<double> displacement{};
    Tensor<double> gradient{};
    (in < n ? displacement[Frame::axes[in]] : gradient.entries[Frame::gradient[in - n].entry]) = 1;
    const auto mesh = physics::mesh_motion(stiffness, sections, displacement, gradient);
    for (int out = 0; out < terms; ++out)
      derivative[out][in] =
          out < n ? mesh.force[Frame::axes[out]] : mesh.stress.entries[Frame::gradient[out - n].entry];
  }
  contract(
      at.weight, vectors, vectors, [&](int out, int in) { return derivative[out][in]; }, at.displacement,
      at.displacement, blocks);
}

namespace detail {

/// `moves`: by the motion of the mesh, too.
template <bool moves, class Frame, int Width>
void add_blood_tangent(const BloodParameters& parameters, const BloodPoint<Frame, Width>& at,
                       const BloodNodes<Frame, Width>& nodes, BloodTangent<Frame, Width>& tangent) {
  constexpr int n = Frame::components, g = gradient_size<Frame>, m = Frame::dimension;
  constexpr int velocity = 0, displacement = n + g, pressure = (moves ? 2 : 1) * (n + g),
                inputs = pressure + 1 + m;
  using D = Dual<double, inputs>;
  const auto plain_state = detail::blood_state(at, nodes);
  const double c = parameters.rate_coefficient;
  physics::BloodState<D> state;
  state.velocity_gradient = seed_gradient<Frame, inputs>(plain_state.velocity_gradient, velocity + n);
  state.acceleration = seed_vector<Frame, inputs>(plain_state.acceleration, velocity, c);
  state.velocity = seed_vector<Frame, inputs>(plain_state.velocity, velocity);
  if constexpr (moves) {
    state.mesh_velocity = seed_vector<Frame, inputs>(plain_state.mesh_velocity, displacement, c);
    state.mesh_gradient = seed_gradient<Frame, inputs>(plain_state.mesh_gradient, displacement + n);
  } else {
    for (int i = 0; i < 3; ++i) state.mesh_velocity[i] = D(plain_state.mesh_velocity[i]);
    for (int k = 0; k < 9; ++k) state.mesh_gradient.entries[k] = D(plain_state.mesh_gradient.entries[k]);
  }
  state.pressure = D::variable(plain_state.pressure, pressure);
  const auto balance = physics::blood_balance(parameters.blood, state);

  constexpr auto vectors = vector_slots<Frame>();
  constexpr auto scalars = scalar_slots<Frame>();
  constexpr std::array<Slot, 1> value{{{0, 0}}};
  const auto momentum = [&](int from) {
    return [&, from](int out, int in) {
      return out < n ? balance.force[Frame::axes[out]].derivative[from + in]
                     : balance.stress.entries[Frame::gradient[out - n].entry].derivative[from + in];
    };
  };
  contract(at.weight, vectors, vectors, momentum(velocity), at.velocity, at.velocity,
           tangent.momentum_velocity);
  if constexpr (moves) {
    contract(at.weight, vectors, vectors, momentum(displacement), at.velocity, at.displacement,
             tangent.momentum_displacement);
    add_mesh_tangent(parameters.mesh_stiffness, parameters.sections, at, tangent.mesh_displacement);
  }
  contract(at.weight, vectors, value, momentum(pressure), at.velocity, at.pressure,
           tangent.momentum_pressure);

  if (parameters.stabilised_size <= 0) {
    const auto continuity = [&](int from) {
      return [&, from](int, int in) { return balance.volume_rate.derivative[from + in]; };
    };
    contract(at.weight, value, vectors, continuity(velocity), at.pressure, at.velocity,
             tangent.continuity_velocity);
    if constexpr (moves)
      contract(at.weight, value, vectors, continuity(displacement), at.pressure, at.displacement,
               tangent.continuity_displacement);
    return;
  }
  Vector<D> pressure_gradient;
  const auto plain_gradient = detail::pressure_gradient(at, nodes);
  for (int i = 0; i < 3; ++i) pressure_gradient[i] = D(plain_gradient[i]);
  for (int k = 0; k < m; ++k) pressure_gradient[Frame::axes[k]].derivative[pressure + 1 + k] = 1;
  const auto flux = physics::pressure_stabilisation(detail::stabilisation(parameters, state.velocity), state,
                                                    balance, pressure_gradient);
  const auto continuity = [&](int from) {
    return [&, from](int out, int in) {
      return out == 0 ? balance.volume_rate.derivative[from + in]
                      : flux[Frame::axes[out - 1]].derivative[from + in];
    };
  };
  contract(at.weight, scalars, vectors, continuity(velocity), at.pressure, at.velocity,
           tangent.continuity_velocity);
  if constexpr (moves)
    contract(at.weight, scalars, vectors, continuity(displacement), at.pressure, at.displacement,
             tangent.continuity_displacement);
  contract(at.weight, scalars, scalars, continuity(pressure), at.pressure, at.pressure,
           tangent.continuity_pressure);
}

}  // namespace detail

/// Adds the derivative of the residual at a quadrature point, those by the motion of the mesh included unless
/// it is given.
template <class Frame, int Width>
void add_blood_tangent(const BloodParameters& parameters, const BloodPoint<Frame, Width>& at,
                       const BloodNodes<Frame, Width>& nodes, BloodTangent<Frame, Width>& tangent) {
  if (parameters.mesh_is_given)
    detail::add_blood_tangent<false>(parameters, at, nodes, tangent);
  else
    detail::add_blood_tangent<true>(parameters, at, nodes, tangent);
}

/// Adds the derivatives of the residual along directions, each given by the nodal values that change with it.
template <std::size_t Directions, class Frame, int Width>
void add_blood_change(const BloodParameters& parameters, const BloodPoint<Frame, Width>& at,
                      const BloodNodes<Frame, Width>& nodes,
                      const std::array<BloodNodes<Frame, Width>, Directions>& along,
                      std::array<BloodResidual<Frame, Width>, Directions>& change) {
  using D = Dual<double, static_cast<int>(Directions)>;
  const auto plain = detail::blood_state(at, nodes);
  auto state = detail::lift<D>(plain);
  Vector<D> pressure_gradient;
  const auto plain_gradient = detail::pressure_gradient(at, nodes);
  for (int i = 0; i < 3; ++i) pressure_gradient[i] = D(plain_gradient[i]);
  for (std::size_t k = 0; k < Directions; ++k) {
    const auto moved = detail::blood_state(at, along[k]);
    for (int i = 0; i < 3; ++i) {
      state.velocity[i].derivative[k] = moved.velocity[i];
      state.acceleration[i].derivative[k] = moved.acceleration[i];
      state.mesh_velocity[i].derivative[k] = moved.mesh_velocity[i];
    }
    for (int e = 0; e < 9; ++e) {
      state.velocity_gradient.entries[e].derivative[k] = moved.velocity_gradient.entries[e];
      state.mesh_gradient.entries[e].derivative[k] = moved.mesh_gradient.entries[e];
    }
    state.pressure.derivative[k] = moved.pressure;
    const auto gradient = detail::pressure_gradient(at, along[k]);
    for (int i = 0; i < 3; ++i) pressure_gradient[i].derivative[k] = gradient[i];
  }
  const auto balance = physics::blood_balance(parameters.blood, state);
  Vector<D> flux{};
  const bool stabilised = parameters.stabilised_size > 0;
  if (stabilised)
    flux = physics::pressure_stabilisation(detail::stabilisation(parameters, state.velocity), state, balance,
                                           pressure_gradient);
  for (std::size_t k = 0; k < Directions; ++k) {
    Vector<double> force;
    Tensor<double> stress, moved;
    for (int i = 0; i < 3; ++i) force[i] = balance.force[i].derivative[k];
    for (int e = 0; e < 9; ++e) {
      stress.entries[e] = balance.stress.entries[e].derivative[k];
      moved.entries[e] = state.mesh_gradient.entries[e].derivative[k];
    }
    test_vector(at.weight, force, stress, at.velocity, change[k].momentum);
    const auto mesh = physics::mesh_motion(parameters.mesh_stiffness, parameters.sections,
                                           field_value(at.displacement, along[k].displacement), moved);
    test_vector(at.weight, mesh.force, mesh.stress, at.displacement, change[k].mesh);
    for (int l = 0; l < Width; ++l) {
      double rate = balance.volume_rate.derivative[k] * at.pressure.lift[0][l];
      if (stabilised)
        for (int a = 0; a < Frame::dimension; ++a)
          rate += flux[Frame::axes[a]].derivative[k] * at.pressure.lift[1 + a][l];
      change[k].continuity[l] += at.weight * rate;
    }
  }
}

}  // namespace tunica::kernel
