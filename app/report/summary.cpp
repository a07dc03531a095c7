// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/report/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "verification/claims.hpp"

namespace tunica::report {

namespace {

using namespace observables;
using Json = nlohmann::ordered_json;

const Json& member(const Json& object, const char* key) {
  static const Json nothing;
  if (!object.is_object()) return nothing;
  const auto found = object.find(key);
  return found == object.end() ? nothing : *found;
}

std::string text_of(const Json& value) {
  return value.is_string() ? value.get<std::string>() : std::string();
}

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
  const Json& scene = member(stored.record, "scene");
  const Table& table = stored.result.observables;
  RunSummary run;
  run.stored = &stored;
  run.name = text_of(member(stored.record, "name"));
  run.law = text_of(member(scene, "wall.law"));
  run.tier = text_of(member(stored.record, "tier"));
  run.beat = last_beat(stored);
  run.period_end = table.find("time")->values.back();

  const std::string failure = text_of(member(stored.record, "failure"));
  run.is_complete = failure.empty() && member(stored.record, "interrupted") != true;
  run.state = !failure.empty()                               ? failure
              : member(stored.record, "interrupted") == true ? "interrupted"
              : member(stored.record, "converged") == false  ? "not converged"
                                                             : "done";

  run.pressure = scaled(range(table, "pressure", run.beat), mmhg);
  run.transmural_pressure = scaled(range(table, "transmural_pressure", run.beat), mmhg);
  const Range displacement = range(table, "radial_displacement.P1", run.beat);
  const Json& radius = member(scene, "geometry.radius");
  if (radius.is_number()) {
    run.radius_change = displacement.width() / radius.get<double>();
    run.largest_radius = displacement.highest / radius.get<double>();
  }
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
