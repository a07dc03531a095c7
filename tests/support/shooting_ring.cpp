// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/shooting_ring.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace tunica::test_support {

namespace {

struct Stress {
  double radial, hoop;  ///< P_RR, P_TT
  double excess;        ///< I4bar - a^2
};

/// P_i = tau_i / lambda_i with lambda_z = 1.
Stress stress(const FiberTissue& t, double radial, double hoop) {
  const double jacobian = radial * hoop;
  const double shrink = std::pow(jacobian, -2.0 / 3.0);
  const double rr = shrink * radial * radial, tt = shrink * hoop * hoop, zz = shrink;
  const double first = rr + tt + zz;
  const double elastin = t.alpha * std::exp(t.gamma * (first - 3));  // 2 dW/dI1
  double tau_r = elastin * (rr - first / 3), tau_t = elastin * (tt - first / 3);

  const double beta = t.angle * std::numbers::pi / 180;
  const double c2 = std::cos(beta) * std::cos(beta), s2 = std::sin(beta) * std::sin(beta);
  const double fourth = tt * c2 + zz * s2;
  const double x = fourth - (t.activation_stretch * t.activation_stretch * c2 + s2);
  const double share = t.sharp ? (x > 0 ? 1.0 : 0.0) : std::atan(t.sharpness * x) / std::numbers::pi + 0.5;
  // The exponential of the square grows above the threshold only.
  const double power = t.exponent == 2 ? x * std::max(x, 0.0) : x;
  const double slope = t.fiber_alpha * std::exp(t.fiber_gamma * power) * (t.exponent == 2 ? 2 * x : 1);
  const double fibers = 2 * share * slope;  // slope is 2 dW/dI4; two families
  tau_r -= fibers * fourth / 3;
  tau_t += fibers * (tt * c2 - fourth / 3);

  const double volumetric = 0.5 * t.kappa * (jacobian * (jacobian - 1) + std::log(jacobian));
  return {(tau_r + volumetric) / radial, (tau_t + volumetric) / hoop, x};
}

/// lambda_R that gives the stress P_RR, which grows with it: bisection to the last bits.
double radial_stretch(const FiberTissue& t, double radial_stress, double hoop) {
  double lower = 0.3 / hoop, upper = 2 / hoop;
  if (stress(t, lower, hoop).radial > radial_stress || stress(t, upper, hoop).radial < radial_stress)
    throw std::runtime_error("shoot: the radial stretch left its bracket");
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (lower + upper);
    (stress(t, middle, hoop).radial < radial_stress ? lower : upper) = middle;
  }
  return 0.5 * (lower + upper);
}

int slope(double radius, const double y[], double dydt[], void* data) {
  const auto& tissue = *static_cast<const FiberTissue*>(data);
  const double hoop = y[0] / radius;
  const double radial = radial_stretch(tissue, y[1] / radius, hoop);
  dydt[0] = radial;
  dydt[1] = stress(tissue, radial, hoop).hoop;
  return GSL_SUCCESS;
}

}  // namespace

ShotRing shoot(const FiberTissue& tissue, double inner_radius, double thickness, double tether_stiffness,
               const std::string& reading, double outer_displacement) {
  FiberTissue data = tissue;
  const double outer_radius = inner_radius + thickness;
  const double outer = outer_radius + outer_displacement;
  const double arm = reading == "reference" ? outer_radius : outer;
  // r and R P_RR
  double y[2] = {outer, -tether_stiffness * outer_displacement * arm};
  const auto excess = [&](double radius) {
    const double hoop = y[0] / radius;
    return stress(data, radial_stretch(data, y[1] / radius, hoop), hoop).excess;
  };
  ShotRing result{};
  result.excess_outer = excess(outer_radius);

  gsl_odeiv2_system system{&slope, nullptr, 2, &data};
  gsl_odeiv2_driver* driver =
      gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, -1e-3 * thickness, 1e-17, 1e-13);
  double radius = outer_radius;
  const int code = gsl_odeiv2_driver_apply(driver, &radius, inner_radius, y);
  gsl_odeiv2_driver_free(driver);
  if (code != GSL_SUCCESS) throw std::runtime_error("shoot: GSL gave up");

  result.excess_inner = excess(inner_radius);
  result.lumen_stretch = y[0] / inner_radius;
  result.inner_displacement = y[0] - inner_radius;
  result.pressure = -y[1] / y[0];  // p r_i = -R_i P_RR
  return result;
}

}  // namespace tunica::test_support
