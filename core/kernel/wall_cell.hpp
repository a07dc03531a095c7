// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "core/kernel/contract.hpp"
#include "core/physics/wall_momentum.hpp"

namespace tunica::kernel {

/// Greatest number of terms of the wall pressure in a cell: 1 and the local coordinates.
template <class Frame>
inline constexpr int max_pressure_terms = 1 + Frame::dimension;

template <class Frame, int Width>
struct WallPoint {
  double weight = 0;  ///< reference volume
  std::array<double, Frame::dimension> place{};
  Lifted<Frame, Width> displacement;
  double pressure[max_pressure_terms<Frame>] = {};  ///< basis of the wall pressure: 1, xi, eta, ...
  wall::MaterialAxes axes{};
};

template <class Frame, int Width>
struct WallNodes {
  NodalVector<Frame, Width> displacement, acceleration;
};

struct WallParameters {
  const wall::Law<double>* law = nullptr;
  double density = 0;
  double rate_coefficient = 0;  ///< d(rate)/d(unknown) of the time scheme, 1/s
  /// Terms of the wall pressure that are used, 0 for the law's own stress at each point.
  int pressure_terms = 0;
  /// The derivative takes the wall pressure for no greater than this, dyn/cm2. Far from a solution that of an
  /// iterate is the bulk modulus times an error of volume, and would make the derivative indefinite; the
  /// residual has it as it is.
  double pressure_bound = std::numeric_limits<double>::infinity();
};

template <class Frame, int Width>
struct WallResidual {
  NodalVector<Frame, Width> momentum;
  double least_jacobian = 1;
};

template <class Frame, int Width>
struct WallTangent {
  Block<Width> momentum[Frame::components][Frame::components];
};

/// Wall pressure of a cell, interpolated on its own and discontinuous between cells: for all q
///   int q (p_wall + V'(theta)) dX = 0,
/// theta the volume strain of the law. It is thus no unknown but the projection of -V'(theta), which keeps
/// nearly incompressible tissue from locking as a mixed method does.
template <class Frame>
class WallPressure {
 public:
  static constexpr int most = max_pressure_terms<Frame>;

  template <int Width>
  WallPressure(const WallParameters& parameters, const std::vector<WallPoint<Frame, Width>>& points,
               const std::vector<Tensor<double>>& gradients)
      : terms_(parameters.pressure_terms) {
    double gram[most][most] = {};
    double load[most] = {};
    const wall::Law<double>& law = *parameters.law;
    for (std::size_t q = 0; q < points.size(); ++q) {
      const double stress = wall::volumetric_stress(law, wall::volume_strain(law, gradients[q]));
      for (int i = 0; i < terms_; ++i) {
        load[i] -= points[q].weight * points[q].pressure[i] * stress;
        for (int j = 0; j < terms_; ++j)
          gram[i][j] += points[q].weight * points[q].pressure[i] * points[q].pressure[j];
      }
    }
    invert(gram);
    for (int i = 0; i < terms_; ++i)
      for (int j = 0; j < terms_; ++j) coefficient_[i] += inverse_[i][j] * load[j];
  }

  double at(const double (&basis)[most]) const {
    double sum = 0;
    for (int i = 0; i < terms_; ++i) sum += coefficient_[i] * basis[i];
    return sum;
  }
  double inverse(int i, int j) const { return inverse_[i][j]; }

 private:
  /// Gauss-Jordan without pivoting: the matrix is symmetric and positive definite.
  void invert(double (&a)[most][most]) {
    for (int i = 0; i < terms_; ++i) inverse_[i][i] = 1;
    for (int k = 0; k < terms_; ++k) {
      const double pivot = 1 / a[k][k];
      for (int j = 0; j < terms_; ++j) {
        a[k][j] *= pivot;
        inverse_[k][j] *= pivot;
      }
      for (int i = 0; i < terms_; ++i) {
        if (i == k) continue;
        const double factor = a[i][k];
        for (int j = 0; j < terms_; ++j) {
          a[i][j] -= factor * a[k][j];
          inverse_[i][j] -= factor * inverse_[k][j];
        }
      }
    }
  }

  int terms_;
  double inverse_[most][most] = {};
  double coefficient_[most] = {};
};

template <class Frame, int Width>
std::vector<Tensor<double>> gradients(const std::vector<WallPoint<Frame, Width>>& points,
                                      const WallNodes<Frame, Width>& nodes) {
  std::vector<Tensor<double>> all(points.size());
  for (std::size_t q = 0; q < points.size(); ++q)
    all[q] = field_gradient(points[q].displacement, nodes.displacement);
  return all;
}

template <class Frame, int Width>
void add_wall_residual(const WallParameters& parameters, const std::vector<WallPoint<Frame, Width>>& points,
                       const WallNodes<Frame, Width>& nodes, WallResidual<Frame, Width>& residual) {
  const auto h = gradients(points, nodes);
  for (const auto& gradient : h)
    residual.least_jacobian = std::min(residual.least_jacobian, 1 + volume_change(gradient));
  if (!(residual.least_jacobian > 0)) return;
  const bool mixed = parameters.pressure_terms > 0;
  std::optional<WallPressure<Frame>> pressure;
  if (mixed) pressure.emplace(parameters, points, h);
  for (std::size_t q = 0; q < points.size(); ++q) {
    const auto& at = points[q];
    const auto force =
        physics::wall_inertia(parameters.density, field_value(at.displacement, nodes.acceleration));
    const auto stress =
        mixed ? physics::mixed_wall_stress(*parameters.law, h[q], at.axes, pressure->at(at.pressure))
              : wall::piola(*parameters.law, h[q], at.axes);
    test_vector(at.weight, force, stress, at.displacement, residual.momentum);
  }
}

/// Adds what a change of the acceleration alone does to the residual, which is linear in it.
template <class Frame, int Width>
void add_inertia(double density, const std::vector<WallPoint<Frame, Width>>& points,
                 const NodalVector<Frame, Width>& acceleration, NodalVector<Frame, Width>& momentum) {
  for (const auto& at : points)
    test_vector(at.weight, physics::wall_inertia(density, field_value(at.displacement, acceleration)),
                Tensor<double>{}, at.displacement, momentum);
}

template <class Frame, int Width>
void add_wall_tangent(const WallParameters& parameters, const std::vector<WallPoint<Frame, Width>>& points,
                      const WallNodes<Frame, Width>& nodes, WallTangent<Frame, Width>& tangent) {
  constexpr int n = Frame::components, g = gradient_size<Frame>, most = max_pressure_terms<Frame>;
  using D = Dual<double, g>;
  constexpr auto slots = vector_slots<Frame>();
  const double mass = parameters.density * parameters.rate_coefficient * parameters.rate_coefficient;
  const auto h = gradients(points, nodes);
  const bool mixed = parameters.pressure_terms > 0;
  std::optional<WallPressure<Frame>> pressure;
  if (mixed) pressure.emplace(parameters, points, h);
  const double projected_share = 1 - physics::pointwise_volumetric_share(*parameters.law);
  const auto bounded = [&](const WallPoint<Frame, Width>& at) {
    return std::clamp(pressure->at(at.pressure), -parameters.pressure_bound, parameters.pressure_bound);
  };
  // Derivatives of the volume and of the projected pressure's load, by nodal displacement.
  NodalVector<Frame, Width> volume[most], load[most];
  for (std::size_t q = 0; q < points.size(); ++q) {
    const auto& at = points[q];
    const auto seeded = seed_gradient<Frame, g>(h[q], 0);
    const Tensor<D> stress = mixed ? physics::mixed_wall_stress(*parameters.law, seeded, at.axes, bounded(at))
                                   : wall::piola(*parameters.law, seeded, at.axes);
    const auto derivative = [&](int out, int in) {
      if (out < n) return out == in ? mass : 0.0;
      return in < n ? 0.0 : stress.entries[Frame::gradient[out - n].entry].derivative[in - n];
    };
    contract(at.weight, slots, slots, derivative, at.displacement, at.displacement, tangent.momentum);
    if (!mixed) continue;
    const double strain = wall::volume_strain(*parameters.law, h[q]);
    const double stiffness =
        projected_share * wall::volumetric_stress(*parameters.law, seed(strain)).derivative[0];
    NodalVector<Frame, Width> change;
    test_vector(1.0, Vector<double>{}, wall::volume_strain_slope(*parameters.law, h[q]), at.displacement,
                change);
    for (int i = 0; i < parameters.pressure_terms; ++i) {
      const double weight = at.weight * at.pressure[i];
      for (int c = 0; c < n; ++c)
        for (int l = 0; l < Width; ++l) {
          volume[i].value[c][l] += weight * change.value[c][l];
          load[i].value[c][l] += weight * stiffness * change.value[c][l];
        }
    }
  }
  for (int i = 0; i < parameters.pressure_terms; ++i)
    for (int j = 0; j < parameters.pressure_terms; ++j)
      for (int a = 0; a < n; ++a)
        for (int b = 0; b < n; ++b)
          for (int k = 0; k < Width; ++k) {
            const double factor = pressure->inverse(i, j) * volume[i].value[a][k];
            for (int l = 0; l < Width; ++l)
              tangent.momentum[a][b].entry[k][l] += factor * load[j].value[b][l];
          }
}

}  // namespace tunica::kernel
