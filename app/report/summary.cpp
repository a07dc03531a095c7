// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/report/summary.hpp"

#include <fmt/format.h>

#include "app/report/labels.hpp"
#include "core/observables/record.hpp"
#include "core/units.hpp"

namespace tunica::report {

namespace {

using namespace observables;
Range scaled(const Range& range, double unit) {
  return {range.lowest / unit, range.highest / unit};
}

Range angles_at(const Table& table, double time) {
  Range angles;
  for (int point = 1; point <= wall_points; ++point)
    angles.include(value_at(table, fmt::format("fiber_angle.P{}", point), time));
  return angles;
}

RunSummary summarize(const StoredResult& stored) {
  const Table& table = stored.result.observables;
  RunSummary run;
  run.stored = &stored;
  run.name = record_text(stored.record, "name");
  run.law = scene_text(stored.record, "wall.law");
  run.tier = record_text(stored.record, "tier");
  run.beat = last_beat(stored);
  run.is_state = table.rows() == 1;
  run.period_end = table.find("time")->values.back();

  const std::string failure = record_text(stored.record, "failure");
  const bool is_interrupted = record_flag(stored.record, "interrupted");
  run.is_complete = failure.empty() && !is_interrupted;
  run.state = !failure.empty()                           ? failure
              : is_interrupted                           ? "interrupted"
              : !record_flag(stored.record, "converged") ? "not converged"
                                                         : "done";

  run.pressure = scaled(range(table, "pressure", run.beat), mmhg);
  run.transmural_pressure = scaled(range(table, "transmural_pressure", run.beat), mmhg);
  const Range displacement = range(table, "radial_displacement.P1", run.beat);
  const double radius = scene_number(stored.record, "geometry.radius");
  run.radius_change = displacement.width() / radius;
  run.largest_radius = displacement.highest / radius;
  const double systole = peak_time(table, "inflow", run.beat);
  run.systole = systole - run.beat.start;
  run.angle_at_start = angles_at(table, run.beat.start);
  run.angle_at_systole = angles_at(table, systole);
  for (int point = 1; point <= wall_points; ++point)
    run.recruited_share[point - 1] = recruited_share(stored.result, point, run.beat);
  return run;
}

}  // namespace

std::vector<RunSummary> summarize(const std::vector<StoredResult>& stored) {
  std::vector<RunSummary> runs;
  const std::vector<std::string> labels = labels_of(stored);
  for (std::size_t index = 0; index < stored.size(); ++index) {
    runs.push_back(summarize(stored[index]));
    runs.back().label = labels[index];
  }
  return runs;
}

}  // namespace tunica::report
