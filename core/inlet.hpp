// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "core/scene/scene.hpp"

namespace tunica {

/// A periodic function of time at the inlet, without its scale.
class Waveform {
 public:
  virtual ~Waveform() = default;
  virtual double at(double time) const = 0;
  /// Times within a period at which it jumps.
  virtual std::vector<double> jumps() const { return {}; }
};

/// The inlet of a scene: flow (cm3/s) or pressure (dyn/cm2), equal to scale * shape(t).
struct Inlet {
  bool is_pressure = false;
  double period = 0;      ///< s
  std::string scale_key;  ///< scene key of the scale; empty for a CSV file, whose scale is 1
  std::unique_ptr<const Waveform> shape;
  double ramp = 0;  ///< s; growth from 0 at the start, see time.ramp

  /// (1 - cos(pi t / ramp))/2 while t < ramp, then 1.
  double growth_at(double time) const;
  /// growth_at(t) shape(t)
  double shape_at(double time) const;
  /// Times between 0 and `end` at which shape_at jumps, ascending.
  std::vector<double> jumps(double end) const;
  /// Largest magnitude of the shape within a period, ramp aside, to within a few per cent.
  double greatest_shape() const;
  /// Mean of the shape over a period, ramp aside: of a trigonometric one exact.
  double mean_shape() const;
  /// A time at which the shape has about its mean over a period, ramp aside.
  double time_of_mean() const;

 private:
  /// The shape at equal steps of a period.
  std::vector<double> samples() const;
};

/// Throws InvalidInput when the scene's CSV file cannot be used.
Inlet inlet_from_scene(const Scene& scene);

}  // namespace tunica
