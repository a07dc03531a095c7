// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "core/observables/result.hpp"
#include "core/radial/ring.hpp"

namespace tunica::lumped {

/// State of the wall in equilibrium at a lumen stretch, at `places` (xi in [0, 1]; a boundary belongs to
/// the inner of its layers). The time of the points is not set. Throws SolverFailure.
std::vector<observables::ProfilePoint> wall_profile(const radial::RingModel& model,
                                                    radial::LumenStretch lumen_stretch,
                                                    std::span<const double> places);

}  // namespace tunica::lumped
