// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "core/tensor.hpp"

/// The method of manufactured solutions: exact smooth fields in, their gradients, rates and divergences out,
/// by duals, so that a forcing follows from its strong form without a formula derived by hand.
///
/// A field is any callable (const Vector<S>& x, const S& t) for every scalar S, double or dual, that returns
/// S, Vector<S> or Tensor<S> (`using std::sin` lets both kinds of scalar find theirs). x holds the
/// coordinates on the frame's tensor axes: (x, y, z), or (r, -, z) with x[1] idle. What comes out of gradient
/// and rate in a lambda is a field again, so operators nest:
///   const auto piola = [&](const auto& x, const auto& t) {
///     return law_stress(manufactured::gradient<manufactured::Axisymmetric>(displacement, x, t));
///   };
///   const Vector<double> force = manufactured::divergence<manufactured::Axisymmetric>(piola, x, t);
/// Errors are round-off. The strong forms are written out here and share nothing with the frames of core.
namespace tunica::test_support::manufactured {

struct Cartesian {
  static constexpr std::array axes{0, 1, 2};
  template <class S>
  static void complete_gradient(Tensor<S>&, const Vector<S>&, const Vector<S>&) {}
  template <class S>
  static void complete_divergence(Vector<S>&, const Tensor<S>&, const Vector<S>&) {}
};

/// Axes (r, theta, z), no swirl, r > 0.
struct Axisymmetric {
  static constexpr std::array axes{0, 2};
  /// (grad u)_tt = u_r / r
  template <class S>
  static void complete_gradient(Tensor<S>& gradient, const Vector<S>& value, const Vector<S>& x) {
    gradient(1, 1) = value[0] / x[0];
  }
  /// (Div P)_r = dP_rr/dr + dP_rz/dz + (P_rr - P_tt)/r, (Div P)_z = dP_zr/dr + dP_zz/dz + P_zr/r
  template <class S>
  static void complete_divergence(Vector<S>& divergence, const Tensor<S>& value, const Vector<S>& x) {
    divergence[0] = divergence[0] + (value(0, 0) - value(1, 1)) / x[0];
    divergence[2] = divergence[2] + value(2, 0) / x[0];
  }
};

/// What a field is asked at to know its derivatives along the axes of the frame.
template <class Frame, class S>
using DualOf = Dual<S, static_cast<int>(Frame::axes.size())>;

namespace detail {

/// Values and directional derivatives of what a field returned.
template <class S, int N>
S value(const Dual<S, N>& x) {
  return x.value;
}
template <class S, int N>
S slope(const Dual<S, N>& x, int direction) {
  return x.derivative[direction];
}
template <class S, int N>
Vector<S> value(const Vector<Dual<S, N>>& v) {
  return {v[0].value, v[1].value, v[2].value};
}
template <class S, int N>
Vector<S> slope(const Vector<Dual<S, N>>& v, int direction) {
  return {v[0].derivative[direction], v[1].derivative[direction], v[2].derivative[direction]};
}
template <class S, int N>
Tensor<S> value(const Tensor<Dual<S, N>>& t) {
  Tensor<S> v;
  for (int k = 0; k < 9; ++k) v.entries[k] = t.entries[k].value;
  return v;
}
template <class S, int N>
Tensor<S> slope(const Tensor<Dual<S, N>>& t, int direction) {
  Tensor<S> v;
  for (int k = 0; k < 9; ++k) v.entries[k] = t.entries[k].derivative[direction];
  return v;
}

/// The field at x with one direction of a dual along each axis of the frame.
template <class Frame, class Field, class S>
auto along_axes(const Field& field, const Vector<S>& x, const S& t) {
  Vector<DualOf<Frame, S>> place{x[0], x[1], x[2]};
  for (std::size_t k = 0; k < Frame::axes.size(); ++k) place[Frame::axes[k]].derivative[k] = S(1.0);
  return field(place, DualOf<Frame, S>(t));
}

template <class S>
void set_slope(Tensor<S>& gradient, int axis, const Vector<S>& slope) {
  for (int i = 0; i < 3; ++i) gradient(i, axis) = slope[i];
}
template <class S>
void set_slope(Vector<S>& gradient, int axis, const S& slope) {
  gradient[axis] = slope;
}

}  // namespace detail

/// Of a scalar field: Vector, d/dx_i. Of a vector field: Tensor, (i, j) = the change of component i along
/// axis j.
template <class Frame, class Field, class S>
auto gradient(const Field& field, const Vector<S>& x, const S& t) {
  const auto around = detail::along_axes<Frame>(field, x, t);
  using Value = decltype(detail::value(around));
  std::conditional_t<std::same_as<Value, S>, Vector<S>, Tensor<S>> result{};
  for (std::size_t k = 0; k < Frame::axes.size(); ++k)
    detail::set_slope(result, Frame::axes[k], detail::slope(around, static_cast<int>(k)));
  if constexpr (!std::same_as<Value, S>) Frame::complete_gradient(result, detail::value(around), x);
  return result;
}

/// Of a vector field: scalar. Of a tensor field: Vector, dP_ij/dx_j with the frame's curvature.
template <class Frame, class Field, class S>
auto divergence(const Field& field, const Vector<S>& x, const S& t) {
  using Value = decltype(detail::value(detail::along_axes<Frame>(field, x, t)));
  if constexpr (std::same_as<Value, Vector<S>>) {
    return trace(gradient<Frame>(field, x, t));
  } else {
    const Tensor<DualOf<Frame, S>> around = detail::along_axes<Frame>(field, x, t);
    Vector<S> result{};
    for (std::size_t k = 0; k < Frame::axes.size(); ++k) {
      const Tensor<S> slope = detail::slope(around, static_cast<int>(k));
      for (int i = 0; i < 3; ++i) result[i] = result[i] + slope(i, Frame::axes[k]);
    }
    Frame::complete_divergence(result, detail::value(around), x);
    return result;
  }
}

/// d/dt at fixed x, of the field's own type.
template <class Field, class S>
auto rate(const Field& field, const Vector<S>& x, const S& t) {
  const Vector<Dual<S, 1>> place{x[0], x[1], x[2]};
  return detail::slope(field(place, seed(t)), 0);
}

/// d2/dt2 at fixed x
template <class Field, class S>
auto second_rate(const Field& field, const Vector<S>& x, const S& t) {
  return rate([&](const auto& place, const auto& time) { return rate(field, place, time); }, x, t);
}

}  // namespace tunica::test_support::manufactured
