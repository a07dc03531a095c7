// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/observables/stops.hpp"

#include <algorithm>
#include <cmath>

namespace tunica::observables {

namespace {

/// 0, interval, 2 interval, ... and `end`, which takes the place of a multiple that round-off sets beside it.
std::vector<double> regular_times(double interval, double end) {
  std::vector<double> times;
  const auto last = static_cast<long>(std::floor(end / interval * (1 + 1e-12)));
  for (long k = 0; k <= last; ++k) times.push_back(std::min(static_cast<double>(k) * interval, end));
  if (end - times.back() > 1e-9 * interval) times.push_back(end);
  return times;
}

}  // namespace

std::vector<Stop> stops(const Scene& scene, double period) {
  const auto beats = static_cast<double>(scene.integer("time.beats"));
  const double end = beats * period;
  std::vector<Stop> all{{.time = (beats - 1) * period, .begins_last_beat = true}};
  for (const double time : regular_times(scene.number("output.interval"), end))
    all.push_back({.time = time, .is_row = true});
  const double field_interval = scene.number("output.field_interval");
  auto pictures = field_interval > 0 ? regular_times(field_interval, end) : std::vector<double>{};
  for (const double time : pictures) all.push_back({.time = time, .is_field = true});
  for (const double within : scene.numbers("output.profile_times")) {
    const double time = (beats - 1) * period + within;
    const bool lacks_picture =
        field_interval > 0 && std::none_of(pictures.begin(), pictures.end(),
                                           [&](double other) { return std::abs(other - time) < 1e-9 * end; });
    if (lacks_picture) pictures.push_back(time);
    all.push_back({.time = time, .is_profile = true, .is_field = lacks_picture});
  }
  std::stable_sort(all.begin(), all.end(), [](const Stop& a, const Stop& b) { return a.time < b.time; });
  return all;
}

}  // namespace tunica::observables
