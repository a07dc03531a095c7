// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "full3d/problem.hpp"

namespace tunica::full3d {

/// A straight or bent vessel of circular cross-section, as o_grid_vessel makes it: coordinates along its
/// centreline, and the directions that belong to them.
struct VesselShape {
  double radius = 0;      ///< of the lumen, cm
  double thickness = 0;   ///< cm
  double length = 0;      ///< of the centreline, cm
  double bend_angle = 0;  ///< rad; 0 for a straight vessel

  /// Section coordinates (x, y) and arc length s along the centreline.
  struct Local {
    double x, y, s;
  };
  double bend_radius() const { return length / bend_angle; }
  /// See o_grid_vessel.
  Point place(const Local& local) const;
  Local local(const Point& place) const;
  /// Unit vectors at an angle from the section's x axis: along its circumference and along the centreline.
  wall::MaterialAxes axes(double angle, double s) const;
  /// Those of the wall at a place.
  wall::MaterialAxes axes(const Point& place) const;
};

}  // namespace tunica::full3d
