// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/observables/event_log.hpp"

#include <fmt/format.h>

#include "core/observables/checkpoint.hpp"

namespace tunica::observables {

EventLog::EventLog(std::vector<EventPlace> places) : places_(std::move(places)), events_(event_table()) {}

void EventLog::record(double time, std::size_t place, bool recruited) {
  append(events_, Event{time, places_[place].point, places_[place].family, recruited});
  if (tallies_.empty()) return;
  Tally& tally = tallies_[place];
  if (tally.recruited) tally.total += time - tally.since;
  tally.since = time;
  tally.recruited = recruited;
}

void EventLog::begin_last_beat(double time, const std::vector<bool>& recruited) {
  tallies_.clear();
  for (const bool is_recruited : recruited) tallies_.push_back({time, 0.0, is_recruited});
}

void EventLog::store(Result& result, double end, bool whole) const {
  result.events = events_;
  if (tallies_.empty() || !whole) return;
  Table table;
  table.add("point", "");
  table.add("family", "1");
  table.add("recruited_time", "s");
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Tally& tally = tallies_[i];
    table[0].labels.push_back(fmt::format("P{}", places_[i].point));
    table[1].values.push_back(static_cast<double>(places_[i].family));
    table[2].values.push_back(tally.total + (tally.recruited ? end - tally.since : 0.0));
  }
  result.recruited_time = std::move(table);
}

nlohmann::json EventLog::save() const {
  std::vector<double> numbers;
  for (const Tally& tally : tallies_)
    numbers.insert(numbers.end(), {tally.since, tally.total, tally.recruited ? 1.0 : 0.0});
  return pack(numbers);
}

void EventLog::restore(const nlohmann::json& saved, const Table& events) {
  events_ = events;
  tallies_.clear();
  const auto numbers = unpack(saved);
  for (std::size_t k = 0; k + 2 < numbers.size(); k += 3)
    tallies_.push_back({numbers[k], numbers[k + 1], numbers[k + 2] != 0});
}

}  // namespace tunica::observables
