// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/observables/beat.hpp"
#include "core/observables/result.hpp"

namespace tunica::verification {

/// How the difference of two runs in a quantity is measured.
enum class Norm {
  relative,    ///< of curves, as parts of the range of the reference over its beat
  angle,       ///< of curves, in degrees
  peak,        ///< of the times of two peaks, in ms, round the beat
  recruitment  ///< time of the beat in which fibres are recruited in one run and not in the other, in ms
};

/// What runs are compared in.
struct Quantity {
  std::string column;  ///< of observables.csv; that of the fibre stretch for Norm::recruitment
  std::string label;   ///< "displacement P1"
  Norm norm = Norm::relative;
  int point = 0;  ///< 1 to wall_points for Norm::recruitment

  /// "1", "deg" or "ms", of differences and limits.
  const char* unit() const;
};

/// Pressures, flows, then P1 to P4 of displacement, fibre angle, fibre stretch, von Mises stress and
/// recruitment, then the times of peaks.
const std::vector<Quantity>& compared_quantities();

/// A run and its last whole beat, in which it is compared.
struct BeatRun {
  const StoredResult* stored = nullptr;
  observables::Beat beat;

  const observables::Table& table() const { return stored->result.observables; }
};

bool has_fibers(const BeatRun& run);

/// When fibres (family 1) at a wall point are recruited, s from the start of the beat.
using Intervals = std::vector<std::pair<double, double>>;
Intervals recruited_in_beat(const BeatRun& run, int point);

/// What the difference in a quantity is measured by, taken from the reference.
struct Yardstick {
  double scale =
      observables::none;  ///< unit of the column for Norm::relative, else 1. The range over the beat, or
                          ///< where that is below a fiftieth of the largest magnitude, the latter
  double limit = observables::none;  ///< in the unit of differences; see yardstick()
};

/// Scale and limit of a quantity for a scene's accuracy.tolerance t (the error allowed in observables,
/// relative to their range):
///   relative     t
///   angle        t/2 rad, what a relative error t of the circumferential stretch turns a fibre at 45° by
///   peak         t times the time that the quantity takes to rise to its peak
///   recruitment  half the time that the fibre stretch is within t of its range to the threshold: the shift
///                of the instants that an error t of the stretch makes
/// The limit is `none` where the reference has no such quantity, or no peak as it hardly moves.
Yardstick yardstick(const Quantity& quantity, const BeatRun& reference, const BeatRun& other,
                    double tolerance);

/// Difference of two runs over the beat.
struct Difference {
  double largest = observables::none;  ///< magnitude
  double rms = observables::none;      ///< over time; `none` for times of peaks and recruitment
  double at = observables::none;       ///< s in the beat, where it is largest
};

/// `none` where one of them has no such quantity.
Difference difference(const Quantity& quantity, const BeatRun& run, const BeatRun& other, double scale);

/// Times of the rows of a beat, counted from its start.
std::vector<double> times_in_beat(const BeatRun& run);
/// Run minus other in a column, at times in the beat; `none` where one of them has no such quantity.
std::vector<double> difference_at(const std::string& column, const BeatRun& run, const BeatRun& other,
                                  const std::vector<double>& times);

}  // namespace tunica::verification
