// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/stability/half_space.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "core/root.hpp"
#include "core/stability/ripple.hpp"

namespace tunica::stability {

using Eigen::Matrix3d;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The matrix sign function by Newton's method (Higham, Functions of Matrices, section 5.3); unlike
/// eigenvectors it does not mind that those of isotropic tissue coincide. None when eigenvalues are on the
/// imaginary axis.
std::optional<Matrix6d> sign(const Matrix6d& matrix) {
  const auto eigenvalues = matrix.eigenvalues();
  if (eigenvalues.real().cwiseAbs().minCoeff() < 1e-6 * eigenvalues.cwiseAbs().maxCoeff()) return {};
  Matrix6d s = matrix;
  // Convergence is quadratic once it sets in, and ends where round-off no longer lets the changes fall.
  double previous = infinity;
  constexpr int most_iterations = 100;
  for (int k = 0; k < most_iterations; ++k) {
    const Matrix6d next = 0.5 * (s + s.inverse());
    const double change = (next - s).cwiseAbs().maxCoeff() / next.cwiseAbs().maxCoeff();
    s = next;
    if (change < 1e-6 && change >= 0.5 * previous) return s;
    if (change == 0) return s;
    previous = change;
  }
  return {};
}

}  // namespace

HalfSpace::HalfSpace(const SurfaceState& surface) : surface_(surface) {}

std::optional<Matrix3d> HalfSpace::stiffness(double angle, double inertia) const {
  const RippleGradient ripple(0, std::sin(angle), {0, 1, 2});
  const auto tangent = matrix_of(surface_.tangent);
  const Eigen::Matrix<double, 9, 3> slope = ripple.slope,
                                    along = ripple.value + std::cos(angle) * ripple.wave;
  const Matrix3d slope_slope = slope.transpose() * tangent * slope;
  const Matrix3d slope_along = slope.transpose() * tangent * along;
  const Matrix3d along_along = along.transpose() * tangent * along + inertia * Matrix3d::Identity();
  const Eigen::LLT<Matrix3d> factor(slope_slope);
  if (factor.info() != Eigen::Success) return {};

  // Stroh's form: displacement d and traction t on surfaces y = const, y = kappa times the place along the
  // radius, t = slope_slope d' + slope_along d and t' = slope_along^T d' + along_along d. It stays regular
  // for incompressible tissue.
  const Matrix3d follow = factor.solve(slope_along);
  const Matrix3d held = along_along - slope_along.transpose() * follow;
  const double unit = held.cwiseAbs().maxCoeff();
  Matrix6d system;
  system << -follow, unit * factor.solve(Matrix3d::Identity()), held / unit, follow.transpose();
  // Ripples that die out inwards belong to eigenvalues of positive real part at the outer surface, of
  // negative ones at the inner surface. The projector's columns span their (d, t).
  const auto s = sign(system);
  if (!s) return {};
  const Matrix6d projector = 0.5 * (Matrix6d::Identity() + surface_.normal * *s);
  const Eigen::Matrix<double, 3, 6> value = projector.topRows<3>(), traction = projector.bottomRows<3>();
  const Matrix3d tissue = unit * traction * value.transpose() * (value * value.transpose()).inverse();
  return surface_.normal * tissue + load_by_gradient(surface_) * along;
}

double HalfSpace::least_stiffness(double angle, double inertia) const {
  const auto s = stiffness(angle, inertia);
  return s ? s->eigenvalues().real().minCoeff() : -infinity;
}

double HalfSpace::growth_speed(double angle, double density) const {
  const double at_rest = least_stiffness(angle);
  if (at_rest == -infinity) return infinity;
  if (at_rest >= 0) return 0;
  // Inertia stiffens the surface without limit.
  double inertia = -at_rest;
  while (least_stiffness(angle, inertia) < 0) inertia *= 2;
  const auto gap = [&](double x) { return least_stiffness(angle, x); };
  return std::sqrt(find_root(gap, 0, inertia, 1e-12 * inertia) / density);
}

}  // namespace tunica::stability
