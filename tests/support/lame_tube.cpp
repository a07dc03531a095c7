// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/lame_tube.hpp"

#include <cmath>
#include <stdexcept>

namespace tunica::test_support {

LameTube::Lame LameTube::lame(double inner_pressure, double axial_strain) const {
  // sigma_rr = 2 (lambda + G) A - 2 G B/r^2 + lambda e: -p at R_i, -K u_r at R_o
  const double lambda = tube_.lame_first(), shear = tube_.shear_modulus(), spring = tube_.radial_spring;
  const double inner = tube_.radius, outer = tube_.outer_radius();
  const double a00 = 2 * (lambda + shear), a01 = -2 * shear / (inner * inner);
  const double a10 = a00 + spring * outer, a11 = -2 * shear / (outer * outer) + spring / outer;
  const double b0 = -inner_pressure - lambda * axial_strain, b1 = -lambda * axial_strain;
  const double determinant = a00 * a11 - a01 * a10;
  return {(b0 * a11 - a01 * b1) / determinant, (a00 * b1 - a10 * b0) / determinant};
}

LameTube::LameTube(const LinearTube& tube, double pressure, double pressure_gradient, double axial_strain)
    : tube_(tube), pressure_(pressure), gradient_(pressure_gradient), strain_(axial_strain) {
  const double lambda = tube.lame_first(), shear = tube.shear_modulus();
  const double inner = tube.radius, outer = tube.outer_radius();
  const bool held = tube.axial_spring > 0;
  if (held && axial_strain != 0)
    throw std::invalid_argument("LameTube: an axial spring leaves no axial strain");

  if (!held) {
    // sigma_rz = 0 at R_o and -tau at R_i: S = -2 R_i tau / (R_o^2 - R_i^2); a depends linearly on q.
    force_slope_ = -2 * inner * wall_shear() / (outer * outer - inner * inner);
    const double loaded = lame(-gradient_, 0).linear, strained = lame(0, 1).linear;
    strain_slope_ = (force_slope_ - 2 * lambda * loaded) / (lambda + 2 * shear + 2 * lambda * strained);
  }
  constant_ = lame(pressure_, strain_);
  slope_ = lame(-gradient_, strain_slope_);
  if (held) force_slope_ = 2 * lambda * slope_.linear;
  shear_ = inner * (-wall_shear() + 0.5 * force_slope_ * inner);
  offset_ = 0;
  if (held) {
    const double traction = shear_ / outer - 0.5 * force_slope_ * outer;
    offset_ = -traction / tube.axial_spring - at(outer).displacement[2];
  } else {
    offset_ = -at(inner).displacement[2];
  }
}

WallPoint<double> LameTube::at(double radius, double z) const {
  const double r = radius, lambda = tube_.lame_first(), shear = tube_.shear_modulus();
  const double linear = constant_.linear + z * slope_.linear,
               inverse = constant_.inverse + z * slope_.inverse;
  const double square = 0.25 * force_slope_ / shear + 0.5 * slope_.linear;
  const double logarithm = shear_ / shear - slope_.inverse;

  WallPoint<double> point{};
  point.displacement = {linear * r + inverse / r, 0,
                        strain_ * z + 0.5 * strain_slope_ * z * z + offset_ - square * r * r +
                            logarithm * std::log(r / tube_.radius)};
  Tensor<double>& h = point.gradient;
  h(0, 0) = linear - inverse / (r * r);
  h(1, 1) = linear + inverse / (r * r);
  h(0, 2) = slope_.linear * r + slope_.inverse / r;
  h(2, 0) = -2 * square * r + logarithm / r;
  h(2, 2) = strain_ + strain_slope_ * z;
  point.stress = lambda * trace(h) * Tensor<double>::identity() + shear * (h + transpose(h));
  return point;
}

}  // namespace tunica::test_support
