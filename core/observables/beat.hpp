// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include "core/observables/result.hpp"

namespace tunica::observables {

/// A heart beat of a run and the rows of observables.csv inside it, `last` included.
struct Beat {
  double start = 0;   ///< s, of the run
  double period = 0;  ///< s
  std::size_t first = 0;
  std::size_t last = 0;
  bool whole = true;  ///< false when the run ended before its first beat was over: all rows it has

  double end() const { return start + period; }
};

/// The last whole beat of a run. The period is the run's length over scene key time.beats, or
/// inlet.period for a run that ended early. Throws InvalidInput when there are no rows.
Beat last_beat(const StoredResult& stored);

/// The same of a run that reached its end, from its scene; of a static state its only row. `last` is before
/// `first` where there are no rows in it.
Beat last_beat(const Scene& scene, const Table& table);

/// Smallest and largest value, both `none` when there is none.
struct Range {
  double lowest = none;
  double highest = none;

  double width() const { return highest - lowest; }
  void include(double value);
};
/// Range of a column over the rows of a beat; `none` when the column is missing or empty.
Range range(const Table& table, std::string_view column, const Beat& beat);

/// Value of a column at a time of the run, linear between rows; `none` outside or when missing.
double value_at(const Table& table, std::string_view column, double time);

/// Time of the run at which a column peaks in the beat: vertex of the parabola through the largest row and
/// its neighbours. `none` when the column is missing or empty.
double peak_time(const Table& table, std::string_view column, const Beat& beat);

/// Mean of a column over the rows of a beat by the trapezoidal rule; `none` when it is missing or empty.
double mean(const Table& table, std::string_view column, const Beat& beat);

/// Flow that counts for none, cm3/s.
inline constexpr double still_flow = 1e-6;

/// A column that does not end the beat where it began it, and by how much it differs there.
struct Unrepeated {
  std::string_view column;
  double change = 0;
  double size = 0;  ///< its largest magnitude in the beat
};
/// Those of pressure, outflow and radial_displacement.P1 that end the beat farther from where they began than
/// `noticed`, a share of their largest magnitude; what is smaller than rounding is not counted.
std::vector<Unrepeated> unrepeated(const Table& table, const Beat& beat, double noticed);

/// Times (start, end) of the run between which fibres (family 1) at a wall point (1 to wall_points) are
/// recruited, clipped to [from, to]. Ends are the times in events.csv; where the run found none, the times at
/// which H, linear between rows, passes 1/2. Empty for a law without fibres.
std::vector<std::pair<double, double>> recruited_intervals(const Result& result, int point, double from,
                                                           double to);

/// Share of the beat (0 to 1) in which fibres at a wall point are recruited; `none` without fibres. Of a beat
/// of a single row, such as a static state, 1 where H > 1/2, else 0.
double recruited_share(const Result& result, int point, const Beat& beat);

}  // namespace tunica::observables
