// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/observables/beat.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/observables/record.hpp"
#include "core/units.hpp"

namespace tunica::observables {

namespace {

const std::vector<double>* numbers(const Table& table, std::string_view name) {
  const Column* column = table.find(name);
  return column && !column->is_text() ? &column->values : nullptr;
}

/// A moment at which fibres of a point switch, and what they are afterwards.
struct Switch {
  double time;
  bool recruited;
};

/// Those of fibre family 1, whose H is in observables.csv.
std::vector<Switch> switches_from_events(const Table& events, const std::string& name) {
  std::vector<Switch> switches;
  const auto* time = numbers(events, "time");
  const auto* family = numbers(events, "family");
  const Column* point = events.find("point");
  const Column* change = events.find("change");
  if (!time || !family || !point || !change || !point->is_text() || !change->is_text()) return switches;
  for (std::size_t row = 0; row < events.rows(); ++row)
    if (point->labels[row] == name && (*family)[row] == 1)
      switches.push_back({(*time)[row], change->labels[row] == "recruited"});
  return switches;
}

/// Those that rows show, for a run without events, as when fibres are on the threshold at rest.
std::vector<Switch> switches_between_rows(const std::vector<double>& time,
                                          const std::vector<double>& recruitment) {
  std::vector<Switch> switches;
  for (std::size_t row = 1; row < time.size(); ++row) {
    const double before = recruitment[row - 1] - 0.5;
    const double after = recruitment[row] - 0.5;
    if ((before > 0) == (after > 0)) continue;
    const double share = before / (before - after);
    switches.push_back({time[row - 1] + share * (time[row] - time[row - 1]), after > 0});
  }
  return switches;
}

}  // namespace

void Range::include(double value) {
  lowest = std::fmin(lowest, value);
  highest = std::fmax(highest, value);
}

Beat last_beat(const StoredResult& stored) {
  const auto* time = numbers(stored.result.observables, "time");
  if (!time || time->empty())
    throw InvalidInput(fmt::format("{}: observables.csv has no rows", stored.folder.string()));
  const double run_end = time->back();
  const bool ended_early =
      record_flag(stored.record, "interrupted") || !record_text(stored.record, "failure").empty();
  const double beats = scene_number(stored.record, "time.beats");
  Beat beat;
  beat.period = scene_number(stored.record, "inlet.period");
  if (!ended_early && beats > 0) beat.period = (run_end - time->front()) / beats;
  if (!(beat.period > 0)) beat.period = run_end - time->front();
  // Output times are sums of steps: half a thousandth of a beat tells a whole beat from a cut one.
  const double count = std::floor((run_end - time->front()) / beat.period + 5e-4);
  beat.whole = count >= 1;
  beat.start = beat.whole ? time->front() + (count - 1) * beat.period : time->front();
  if (!beat.whole) beat.period = run_end - time->front();
  const double slack = 1e-9 * beat.period;
  beat.first = std::lower_bound(time->begin(), time->end(), beat.start - slack) - time->begin();
  beat.last = std::upper_bound(time->begin(), time->end(), beat.end() + slack) - time->begin() - 1;
  return beat;
}

Beat last_beat(const Scene& scene, const Table& table) {
  Beat beat;
  const std::vector<double>& time = table.find("time")->values;
  beat.last = time.size() - 1;
  if (scene.text("time.mode") == "static") return beat;
  beat.period = scene.number("inlet.period");
  beat.start = static_cast<double>(scene.integer("time.beats") - 1) * beat.period;
  const double slack = 1e-9 * beat.period;
  beat.first =
      static_cast<std::size_t>(std::lower_bound(time.begin(), time.end(), beat.start - slack) - time.begin());
  return beat;
}

Range range(const Table& table, std::string_view column, const Beat& beat) {
  Range found;
  if (const auto* values = numbers(table, column))
    for (std::size_t row = beat.first; row <= beat.last && row < values->size(); ++row)
      found.include((*values)[row]);
  return found;
}

double value_at(const Table& table, std::string_view column, double time) {
  const auto* times = numbers(table, "time");
  const auto* values = numbers(table, column);
  if (!times || !values || times->empty()) return none;
  const double slack = 1e-9 * (times->back() - times->front());
  if (time < times->front() - slack || time > times->back() + slack) return none;
  const std::size_t after = std::min<std::size_t>(
      std::lower_bound(times->begin(), times->end(), time) - times->begin(), times->size() - 1);
  if (after == 0 || (*times)[after] <= time) return (*values)[after];
  const double share = (time - (*times)[after - 1]) / ((*times)[after] - (*times)[after - 1]);
  return (1 - share) * (*values)[after - 1] + share * (*values)[after];
}

double peak_time(const Table& table, std::string_view column, const Beat& beat) {
  const auto* time = numbers(table, "time");
  const auto* values = numbers(table, column);
  if (!time || !values) return none;
  std::size_t top = beat.first;
  for (std::size_t row = beat.first; row <= beat.last; ++row)
    if (is_none((*values)[top]) || (*values)[row] > (*values)[top]) top = row;
  if (is_none((*values)[top])) return none;
  if (top == beat.first || top == beat.last) return (*time)[top];
  const double left = (*time)[top] - (*time)[top - 1];
  const double right = (*time)[top + 1] - (*time)[top];
  const double fall_left = (*values)[top] - (*values)[top - 1];
  const double fall_right = (*values)[top] - (*values)[top + 1];
  const double curvature = fall_left * right + fall_right * left;
  if (!(curvature > 0)) return (*time)[top];
  return (*time)[top] + 0.5 * (fall_left * right * right - fall_right * left * left) / curvature;
}

double mean(const Table& table, std::string_view column, const Beat& beat) {
  const auto* time = numbers(table, "time");
  const auto* values = numbers(table, column);
  if (!time || !values || values->empty()) return none;
  if (beat.first == beat.last) return (*values)[beat.last];
  double sum = 0;
  for (std::size_t row = beat.first; row < beat.last; ++row)
    sum += 0.5 * ((*values)[row] + (*values)[row + 1]) * ((*time)[row + 1] - (*time)[row]);
  return sum / ((*time)[beat.last] - (*time)[beat.first]);
}

std::vector<Unrepeated> unrepeated(const Table& table, const Beat& beat, double noticed) {
  struct Watched {
    std::string_view column;
    double still;  ///< what is smaller is rounding
  };
  constexpr Watched all[] = {
      {"pressure", 1e-2 * mmhg}, {"outflow", still_flow}, {"radial_displacement.P1", 1e-6}};
  std::vector<Unrepeated> found;
  for (const auto& [column, still] : all) {
    const Range over = range(table, column, beat);
    const auto* values = numbers(table, column);
    if (!values || is_none(over.lowest)) continue;
    const double change = (*values)[beat.last] - (*values)[beat.first];
    const double size = std::max(std::abs(over.lowest), std::abs(over.highest));
    if (std::abs(change) > std::max(noticed * size, still)) found.push_back({column, change, size});
  }
  return found;
}

std::vector<std::pair<double, double>> recruited_intervals(const Result& result, int point, double from,
                                                           double to) {
  const std::string name = fmt::format("P{}", point);
  const auto* time = numbers(result.observables, "time");
  const auto* recruitment = numbers(result.observables, "recruitment." + name);
  if (!time || !recruitment || time->empty() || is_none(recruitment->front())) return {};
  // Tissue that lingers at its threshold has H that wavers about 1/2 in the rows: events go before rows.
  std::vector<Switch> switches = switches_from_events(result.events, name);
  const bool has_events = !switches.empty();
  if (!has_events) switches = switches_between_rows(*time, *recruitment);
  std::vector<std::pair<double, double>> intervals;
  bool recruited = has_events ? !switches.front().recruited : recruitment->front() > 0.5;
  double since = time->front();
  const auto close = [&](double end) {
    const double start = std::max(since, from);
    if (recruited && std::min(end, to) > start) intervals.emplace_back(start, std::min(end, to));
  };
  for (const Switch& change : switches) {
    if (change.recruited == recruited) continue;
    close(change.time);
    recruited = change.recruited;
    since = change.time;
  }
  close(time->back());
  return intervals;
}

double recruited_share(const Result& result, int point, const Beat& beat) {
  const auto* recruitment = numbers(result.observables, fmt::format("recruitment.P{}", point));
  if (!recruitment || recruitment->empty() || is_none(recruitment->front())) return none;
  // Of a single row there is no time to take a share of.
  if (beat.first == beat.last) return (*recruitment)[beat.first] > 0.5 ? 1 : 0;
  double sum = 0;
  for (const auto& [start, end] : recruited_intervals(result, point, beat.start, beat.end()))
    sum += end - start;
  return sum / beat.period;
}

}  // namespace tunica::observables
