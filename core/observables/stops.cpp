// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/observables/stops.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/memory.hpp"

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
  // One state has no times.
  if (scene.text("time.mode") == "static") return {{.time = end}};
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

void check_output_memory(const Scene& scene, const std::vector<Stop>& stops, std::size_t columns,
                         std::size_t numbers, double copies) {
  check_output_memory(scene, stops, columns, numbers, copies, available_memory());
}

void check_output_memory(const Scene& scene, const std::vector<Stop>& stops, std::size_t columns,
                         std::size_t numbers, double copies, std::optional<double> available) {
  // A table's text is made at once; that of pictures is written time by time.
  constexpr double text_of_number = 20;
  const auto count = [&](bool Stop::*kind) {
    return static_cast<double>(
        std::count_if(stops.begin(), stops.end(), [&](const Stop& stop) { return stop.*kind; }));
  };
  const double rows = count(&Stop::is_row), pictures = count(&Stop::is_field);
  const double of_rows = rows * static_cast<double>(columns) * (copies * sizeof(double) + text_of_number);
  const double of_pictures = pictures * static_cast<double>(numbers) * copies * sizeof(float);
  if (!available || of_rows + of_pictures <= *available) return;
  const bool rows_weigh = of_rows > of_pictures;
  const char* key = rows_weigh ? "output.interval" : "output.field_interval";
  throw InvalidInput(
      fmt::format("{} = {:.6g} s makes {:.0f} {}, for which a run takes an estimated {:.3g} GiB, and "
                  "{:.3g} GiB are available; give a longer time{}",
                  key, scene.number(key), rows_weigh ? rows : pictures, rows_weigh ? "rows" : "pictures",
                  (of_rows + of_pictures) / gib, *available / gib, rows_weigh ? "" : ", or 0 for none"));
}

}  // namespace tunica::observables
