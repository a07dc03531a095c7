// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/observables/event_log.hpp"

#include <fmt/format.h>

#include "core/observables/checkpoint.hpp"

namespace tunica::observables {

EventLog::EventLog(std::vector<EventPlace> places, std::vector<std::string> keys)
    : places_(std::move(places)), keys_(std::move(keys)), events_(event_table()) {
  if (keys_.empty()) return;
  event_sensitivities_ = event_table();
  add_sensitivity_columns(event_sensitivities_, "time", "s", keys_);
}

void EventLog::record(double time, std::size_t place, bool recruited, const std::vector<double>& moved) {
  const Event event{time, places_[place].point, places_[place].family, recruited};
  append(events_, event);
  if (!keys_.empty()) {
    const std::size_t first = events_.columns().size();
    append(event_sensitivities_, event);
    for (std::size_t k = 0; k < keys_.size(); ++k) event_sensitivities_[first + k].values.push_back(moved[k]);
  }
  if (tallies_.empty()) return;
  Tally& tally = tallies_[place];
  if (tally.recruited) tally.total += time - tally.since;
  for (std::size_t k = 0; k < keys_.size(); ++k) tally.derivatives[k] += recruited ? -moved[k] : moved[k];
  tally.since = time;
  tally.recruited = recruited;
}

void EventLog::begin_last_beat(double time, const std::vector<bool>& recruited) {
  tallies_.clear();
  for (const bool is_recruited : recruited)
    tallies_.push_back({time, 0.0, is_recruited, std::vector<double>(keys_.size(), 0.0)});
}

void EventLog::store(Result& result, double end, bool whole) const {
  result.events = events_;
  result.event_sensitivities = event_sensitivities_;
  if (tallies_.empty() || !whole) return;
  Table table;
  table.add("point", "");
  table.add("family", "1");
  table.add("recruited_time", "s");
  add_sensitivity_columns(table, "recruited_time", "s", keys_);
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Tally& tally = tallies_[i];
    table[0].labels.push_back(fmt::format("P{}", places_[i].point));
    table[1].values.push_back(static_cast<double>(places_[i].family));
    table[2].values.push_back(tally.total + (tally.recruited ? end - tally.since : 0.0));
    for (std::size_t k = 0; k < keys_.size(); ++k) table[3 + k].values.push_back(tally.derivatives[k]);
  }
  result.recruited_time = std::move(table);
}

nlohmann::json EventLog::save() const {
  std::vector<double> numbers;
  for (const Tally& tally : tallies_) {
    numbers.insert(numbers.end(), {tally.since, tally.total, tally.recruited ? 1.0 : 0.0});
    numbers.insert(numbers.end(), tally.derivatives.begin(), tally.derivatives.end());
  }
  return pack(numbers);
}

void EventLog::restore(const nlohmann::json& saved, const Result& so_far) {
  events_ = so_far.events;
  event_sensitivities_ = so_far.event_sensitivities;
  tallies_.clear();
  const auto numbers = unpack(saved);
  const std::size_t length = 3 + keys_.size();
  for (auto at = numbers.begin(); at != numbers.end(); at += static_cast<std::ptrdiff_t>(length))
    tallies_.push_back({at[0], at[1], at[2] != 0, {at + 3, at + static_cast<std::ptrdiff_t>(length)}});
}

}  // namespace tunica::observables
