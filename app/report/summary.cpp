// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/report/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "core/observables/record.hpp"
#include "verification/claims.hpp"

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

/// Gives every run the shortest label of a few that tells all of them apart.
void label(std::vector<RunSummary>& runs) {
  using Labeller = std::function<std::string(const RunSummary&)>;
  const auto reading = [](const RunSummary& run) { return verification::reading_of(*run.stored); };
  const Labeller labellers[] = {
      [](const RunSummary& run) { return run.law; },
      [](const RunSummary& run) { return fmt::format("{}, {}", run.law, run.tier); },
      [](const RunSummary& run) { return fmt::format("{}, {}", run.law, run.name); },
      [&](const RunSummary& run) { return fmt::format("{}, {}", run.law, reading(run)); },
      [&](const RunSummary& run) { return fmt::format("{}, {}, {}", run.law, run.name, reading(run)); },
      [](const RunSummary& run) { return fmt::format("{}, {}", run.law, run.stored->folder.string()); }};
  for (const Labeller& labeller : labellers) {
    std::vector<std::string> labels;
    for (RunSummary& run : runs) labels.push_back(run.label = labeller(run));
    std::sort(labels.begin(), labels.end());
    if (std::adjacent_find(labels.begin(), labels.end()) == labels.end()) return;
  }
  for (std::size_t index = 0; index < runs.size(); ++index)
    runs[index].label += fmt::format(" ({})", index + 1);
}

}  // namespace

std::vector<RunSummary> summarize(const std::vector<StoredResult>& stored) {
  std::vector<RunSummary> runs;
  for (const StoredResult& one : stored) runs.push_back(summarize(one));
  label(runs);
  return runs;
}

}  // namespace tunica::report
