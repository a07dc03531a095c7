// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/vessel_shape.hpp"

#include <cmath>
#include <numbers>

namespace tunica::full3d {

Point VesselShape::place(const Local& local) const {
  if (bend_angle == 0) return {local.x, local.y, local.s};
  const double bend = bend_radius(), phi = local.s / bend;
  return {(bend + local.x) * std::cos(phi) - bend, local.y, (bend + local.x) * std::sin(phi)};
}

VesselShape::Local VesselShape::local(const Point& place) const {
  if (bend_angle == 0) return {place[0], place[1], place[2]};
  const double bend = bend_radius();
  double phi = std::atan2(place[2], place[0] + bend);
  // Beyond half a turn the angle goes on; places lie on the vessel, so that none is as far before its inlet.
  if (phi < -0.5 * (2 * std::numbers::pi - bend_angle)) phi += 2 * std::numbers::pi;
  return {std::hypot(place[0] + bend, place[2]) - bend, place[1], bend * phi};
}

wall::MaterialAxes VesselShape::axes(double angle, double s) const {
  const double c = std::cos(angle), d = std::sin(angle);
  const double phi = bend_angle == 0 ? 0 : s / bend_radius();
  const Vector<double> out{std::cos(phi), 0, std::sin(phi)}, along{-std::sin(phi), 0, std::cos(phi)};
  return {{-d * out[0], c, -d * out[2]}, along};
}

wall::MaterialAxes VesselShape::axes(const Point& place) const {
  const Local at = local(place);
  return axes(std::atan2(at.y, at.x), at.s);
}

}  // namespace tunica::full3d
