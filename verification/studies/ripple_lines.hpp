// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/observables/table.hpp"

namespace tunica::verification {

/// The lumen along the artery at one time.
struct LumenLine {
  double time = 0;                ///< s
  std::vector<double> z, radius;  ///< cm, of the deformed wall
};

/// The lines of along.csv, in the order of their times.
std::vector<LumenLine> lumen_lines(const observables::Table& along);

/// Departure of a lumen from a smooth shape, the cubic that fits it best, in the middle 54 % of the artery,
/// where the ends are not felt.
struct Ripples {
  double amplitude = 0;    ///< cm, the greatest departure
  double wave_length = 0;  ///< cm, twice the mean distance of changes of sign; 0 with fewer than two
};
Ripples ripples(const LumenLine& line, double length);

}  // namespace tunica::verification
