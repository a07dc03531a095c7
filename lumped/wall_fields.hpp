// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/observables/field_series.hpp"
#include "core/radial/ring.hpp"

namespace tunica::lumped {

/// The wall's cross-section at mid-length as a picture: a ring of quadrilaterals in the unloaded
/// configuration (x, y across the artery, z = length/2), whose cells end where layers end.
class WallFields {
 public:
  WallFields(const radial::RingModel& model, double length);

  /// The ring with the cell field "layer" (0 for the inner one) and the names of the point fields:
  /// displacement, stresses, and with fibres recruitment and fiber_stretch of family 1. No frames.
  observables::FieldSeries empty_series() const;
  /// Appends the ring in equilibrium at a lumen stretch. Throws SolverFailure.
  void append(double time, radial::LumenStretch lumen_stretch, observables::FieldSeries& series) const;

 private:
  const radial::RingModel& model_;
  double length_;
  /// xi of the circles of points, inside to outside. A boundary between layers has two, the state of
  /// the wall being another on either side of it.
  std::vector<double> places_;
  std::vector<int> place_layers_;
  bool has_fibers_ = false;
};

}  // namespace tunica::lumped
