// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "full3d/layout.hpp"
#include "full3d/locate.hpp"
#include "full3d/setup.hpp"

namespace tunica::full3d {

/// A straight line across the wall.
struct Across {
  Point begin;         ///< on the interface
  Vector<double> out;  ///< of length 1
  double radius;       ///< of `begin`, from the centreline, cm
  double thickness;    ///< cm
  Point at(double depth) const {
    return {begin[0] + depth * out[0], begin[1] + depth * out[1], begin[2] + depth * out[2]};
  }
};

/// A point of the interface on the line that P1 is on.
struct AlongPoint {
  Point point;
  double s;       ///< along the centreline, cm
  double radius;  ///< from it
};

/// How observers find their way in an unloaded vessel. Mid-length is half way along the centreline. Angles
/// are about the centreline, from an x axis of the section that does not twist along it.
class Course {
 public:
  virtual ~Course() = default;
  /// The line across the wall at mid-length.
  virtual Across across(double angle) const = 0;
  /// Depths of the faces between wall cells that such a line crosses from face to face, ascending from 0;
  /// empty where it crosses cells otherwise.
  virtual std::vector<double> cell_lines(const Across& across) const = 0;
  /// From the inlet to the outlet, at angle 0.
  virtual std::vector<AlongPoint> along() const = 0;
  /// Degrees at which the wall differs from that at angle 0.
  virtual std::vector<int> further_angles() const = 0;
  /// Mean pressure of a state over the current lumen section at mid-length; empty without blood.
  virtual std::function<double(std::span<const double> y)> section_pressure(const Layout& layout) const = 0;
};

/// That of a cylinder or torus, or of a mesh from a file. Setup and locator must outlive it, what
/// section_pressure() gives needs the setup and the layout.
std::unique_ptr<const Course> course_of(const Setup& setup, const Locator& locator);

}  // namespace tunica::full3d
