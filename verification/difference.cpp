// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/difference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tunica::verification {

namespace {

using namespace observables;

constexpr double milliseconds = 1e3;

/// A quantity that varies by less than this part of its magnitude over the beat hardly moves.
constexpr double hardly_moves = 0.02;

double value_in_beat(const BeatRun& run, const std::string& column, double time) {
  return value_at(run.table(), column, std::min(run.beat.start + time, run.beat.end()));
}

double scale_of(const Range& range) {
  const double magnitude = std::max(std::abs(range.lowest), std::abs(range.highest));
  return range.width() < hardly_moves * magnitude ? magnitude : range.width();
}

bool moves(const Range& range) {
  return range.width() > 0 && scale_of(range) == range.width();
}

double length(const Intervals& intervals) {
  double sum = 0;
  for (const auto& [from, to] : intervals) sum += to - from;
  return sum;
}

double common_length(const Intervals& a, const Intervals& b) {
  double sum = 0;
  for (const auto& [from, to] : a)
    for (const auto& [other_from, other_to] : b)
      sum += std::max(0.0, std::min(to, other_to) - std::max(from, other_from));
  return sum;
}

/// Fibre stretch at which a run switches, seen where it first does within its beat.
double threshold(const BeatRun& run, const Quantity& quantity) {
  const double slack = 1e-6 * run.beat.period;
  for (const auto& [from, to] : recruited_in_beat(run, quantity.point))
    for (const double time : {from, to})
      if (time > slack && time < run.beat.period - slack) return value_in_beat(run, quantity.column, time);
  return none;
}

/// Time that a curve, linear between rows, spends within `band` of a level.
double time_near(const BeatRun& run, const std::string& column, double level, double band) {
  const std::vector<double> times = times_in_beat(run);
  const auto& values = run.table().find(column)->values;
  double sum = 0;
  for (std::size_t row = 1; row < times.size(); ++row) {
    const double left = values[run.beat.first + row - 1] - level,
                 right = values[run.beat.first + row] - level;
    const double low = std::min(left, right), high = std::max(left, right);
    const double inside = std::max(0.0, std::min(high, band) - std::max(low, -band));
    const double share = high > low ? inside / (high - low) : (std::abs(low) <= band ? 1.0 : 0.0);
    sum += share * (times[row] - times[row - 1]);
  }
  return sum;
}

/// Time in which a quantity climbs to its peak from its lowest value, round the beat.
double rise_time(const BeatRun& run, const std::string& column) {
  const auto& values = run.table().find(column)->values;
  const auto begin = values.begin() + static_cast<long>(run.beat.first);
  const auto end = values.begin() + static_cast<long>(run.beat.last) + 1;
  const double lowest =
      run.table()
          .find("time")
          ->values[run.beat.first + static_cast<std::size_t>(std::min_element(begin, end) - begin)];
  const double rise = peak_time(run.table(), column, run.beat) - lowest;
  return rise > 0 ? rise : rise + run.beat.period;
}

Difference curve_difference(const Quantity& quantity, const BeatRun& run, const BeatRun& other,
                            double scale) {
  const std::vector<double> times = times_in_beat(other);
  const std::vector<double> values = difference_at(quantity.column, run, other, times);
  Difference found;
  double sum = 0, duration = 0;
  for (std::size_t row = 0; row < times.size(); ++row) {
    const double size = std::abs(values[row]) / scale;
    if (is_none(size)) continue;
    if (is_none(found.largest) || size > found.largest) {
      found.largest = size;
      found.at = times[row];
    }
    const double before = row > 0 ? times[row - 1] : times[row];
    const double after = row + 1 < times.size() ? times[row + 1] : times[row];
    sum += size * size * 0.5 * (after - before);
    duration += 0.5 * (after - before);
  }
  if (duration > 0) found.rms = std::sqrt(sum / duration);
  return found;
}

Difference peak_difference(const Quantity& quantity, const BeatRun& run, const BeatRun& other) {
  const double peak = peak_time(other.table(), quantity.column, other.beat) - other.beat.start;
  const double shift = peak_time(run.table(), quantity.column, run.beat) - run.beat.start - peak;
  Difference found;
  // A peak at the end of the beat is near one at its start.
  found.largest = milliseconds * std::abs(std::remainder(shift, other.beat.period));
  found.at = peak;
  return found;
}

Difference recruitment_difference(const Quantity& quantity, const BeatRun& run, const BeatRun& other) {
  Difference found;
  if (!has_fibers(run) || !has_fibers(other)) return found;
  const Intervals ours = recruited_in_beat(run, quantity.point),
                  theirs = recruited_in_beat(other, quantity.point);
  const double apart = length(ours) + length(theirs) - 2 * common_length(ours, theirs);
  found.largest = milliseconds * std::max(0.0, apart);
  return found;
}

void add_points(std::vector<Quantity>& all, const std::string& column, const std::string& label, Norm norm) {
  for (int point = 1; point <= wall_points; ++point)
    all.push_back({fmt::format("{}.P{}", column, point), fmt::format("{} P{}", label, point), norm, point});
}

std::vector<Quantity> all_quantities() {
  std::vector<Quantity> all{{"pressure", "pressure"},
                            {"outlet_pressure", "outlet pressure"},
                            {"transmural_pressure", "transmural pressure"},
                            {"inflow", "inflow"},
                            {"outflow", "outflow"}};
  add_points(all, "radial_displacement", "displacement", Norm::relative);
  add_points(all, "fiber_angle", "fibre angle", Norm::angle);
  add_points(all, "fiber_stretch", "fibre stretch", Norm::relative);
  add_points(all, "von_mises", "von Mises", Norm::relative);
  add_points(all, "fiber_stretch", "recruitment", Norm::recruitment);
  all.push_back({"pressure", "peak of pressure", Norm::peak});
  all.push_back({"outflow", "peak of outflow", Norm::peak});
  all.push_back({"radial_displacement.P1", "peak of displ. P1", Norm::peak});
  return all;
}

}  // namespace

const char* Quantity::unit() const {
  return norm == Norm::relative ? "1" : norm == Norm::angle ? "deg" : "ms";
}

const std::vector<Quantity>& compared_quantities() {
  static const std::vector<Quantity> all = all_quantities();
  return all;
}

bool has_fibers(const BeatRun& run) {
  return !is_none(recruited_share(run.stored->result, 1, run.beat));
}

Intervals recruited_in_beat(const BeatRun& run, int point) {
  Intervals intervals = recruited_intervals(run.stored->result, point, run.beat.start, run.beat.end());
  for (auto& [from, to] : intervals) {
    from -= run.beat.start;
    to -= run.beat.start;
  }
  return intervals;
}

Yardstick yardstick(const Quantity& quantity, const BeatRun& reference, const BeatRun& other,
                    double tolerance) {
  const Range range = observables::range(reference.table(), quantity.column, reference.beat);
  Yardstick found;
  if (is_none(range.lowest)) return found;
  found.scale = 1;
  switch (quantity.norm) {
    case Norm::relative:
      // A quantity that is 0 throughout has no size of its own.
      found.scale = scale_of(range) > 0 ? scale_of(range) : 1;
      found.limit = tolerance;
      break;
    case Norm::angle:
      found.limit = 0.5 * tolerance * 180 / std::numbers::pi;
      break;
    case Norm::peak:
      if (moves(range)) found.limit = milliseconds * tolerance * rise_time(reference, quantity.column);
      break;
    case Norm::recruitment: {
      double level = threshold(reference, quantity);
      if (is_none(level)) level = threshold(other, quantity);
      const double band = tolerance * range.width();
      found.limit =
          is_none(level) ? 0 : 0.5 * milliseconds * time_near(reference, quantity.column, level, band);
      break;
    }
  }
  return found;
}

Difference difference(const Quantity& quantity, const BeatRun& run, const BeatRun& other, double scale) {
  if (quantity.norm == Norm::peak) return peak_difference(quantity, run, other);
  if (quantity.norm == Norm::recruitment) return recruitment_difference(quantity, run, other);
  return curve_difference(quantity, run, other, scale);
}

std::vector<double> times_in_beat(const BeatRun& run) {
  const auto& all = run.table().find("time")->values;
  std::vector<double> times;
  for (std::size_t row = run.beat.first; row <= run.beat.last; ++row)
    times.push_back(all[row] - run.beat.start);
  return times;
}

std::vector<double> difference_at(const std::string& column, const BeatRun& run, const BeatRun& other,
                                  const std::vector<double>& times) {
  std::vector<double> values;
  for (const double time : times)
    values.push_back(value_in_beat(run, column, time) - value_in_beat(other, column, time));
  return values;
}

}  // namespace tunica::verification
