// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "axisym/problem.hpp"
#include "axisym/resolution.hpp"
#include "core/inlet.hpp"
#include "core/radial/ring.hpp"

namespace tunica::axisym {

/// A scene in the terms of this tier. Stays where it was made: the problem's functions refer to it.
struct Setup {
  Resolution resolution;
  Inlet inlet;
  double inlet_scale = 0;  ///< mean flow (cm3/s) or pressure (dyn/cm2)
  /// Factor on everything that loads the vessel, for static states that are approached from rest.
  double load = 1;
  Problem problem;
  /// Ring of the wall at mid-length, none when there is no wall.
  std::unique_ptr<const radial::RingModel> ring;
  double lumen_radius = 0;       ///< at mid-length, cm
  double expected_pressure = 0;  ///< greatest in the lumen, dyn/cm2, estimated from the outlet's resistance
  Newton::Sizes expected;        ///< sizes of the fields to come

  Setup() = default;
  Setup(const Setup&) = delete;
  Setup& operator=(const Setup&) = delete;
  double inlet_value(double time) const { return load * inlet_scale * inlet.shape_at(time); }
};

/// Throws InvalidInput for a scene that this tier cannot compute.
std::unique_ptr<Setup> setup_of(const Scene& scene);
/// The same with other numbers of cells than the scene asks for.
std::unique_ptr<Setup> setup_of(const Scene& scene, const Resolution& resolution);

}  // namespace tunica::axisym
