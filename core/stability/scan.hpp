// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "core/stability/strip.hpp"

namespace tunica::stability {

/// A ripple of the strip by its wave length along the axis, cm (0: the limit of short waves), and m.
struct Ripple {
  double length;
  int around = 0;
};

/// Ripples of m = 0 to `most_around`, each of all wave lengths, cm.
struct Ripples {
  std::vector<double> lengths;
  int most_around = 0;
  bool twist = false;  ///< d_theta at m = 0 as well, see Strip
};

/// `count` wave lengths in equal ratios from the shortest to the longest.
std::vector<double> wave_lengths(double shortest, double longest, int count);

/// Those that grow out of the base state, see Strip::is_stable.
std::vector<Ripple> unstable_ripples(const BaseState& base, const Ripples& ripples);

/// Ripples of length 0 when those of the outer surface along the axis (`oblique`: in any direction) grow in
/// the limit of short waves, so that the problem is ill-posed, see HalfSpace.
std::vector<Ripple> ill_posed_ripples(const BaseState& base, bool oblique);

/// A stretch of the curve of equilibria on which the wall is unstable.
struct UnstableRange {
  double lower, upper;  ///< least and greatest lumen pressure on it, dyn/cm2
  /// It begins or ends where the scan does, and so may go on.
  bool open_below, open_above;
  Ripple first;  ///< at its least lumen stretch, the longest of the unstable ripples
  Ripple last;   ///< the same at its greatest lumen stretch
};

struct Scan {
  double lower, upper;      ///< lumen pressures, dyn/cm2
  int steps = 64;           ///< of equal lumen stretch; a range narrower than one can be missed
  double tolerance = 1e-6;  ///< of the lumen stretch at the ends of a range
  Resolution resolution = {};
};

/// Where `search` finds ripples, in the order of growing lumen stretch. Throws SolverFailure when the wall
/// has no equilibrium within the scan.
std::vector<UnstableRange> unstable_ranges(
    const radial::RingModel& model, const Scan& scan,
    const std::function<std::vector<Ripple>(const BaseState&)>& search);

}  // namespace tunica::stability
