// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/report/sweep_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/report/labels.hpp"
#include "app/report/sections.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "verification/sweep/campaign.hpp"
#include "verification/sweep/fidelity_points.hpp"

namespace tunica::report {

namespace {

using Json = nlohmann::ordered_json;
using observables::is_none;
using observables::none;

constexpr std::size_t most_levels = 25;  // a value each
constexpr std::size_t bins = 12;         // where there are more values
constexpr std::size_t most_listed = 20;

/// Equal ratios, or a range that a linear axis would press together.
bool spreads_in_ratios(const Json& parameter, const SweepKey& key) {
  if (key.is_text() || !(key.lowest > 0)) return false;
  if (parameter.contains("distribution"))
    return parameter.at("distribution").get<std::string>().starts_with("log");
  const auto& at = key.places;
  if (at.size() > 2 && !key.is_binned) {
    const double ratio = at[1] / at[0];
    const bool is_equal = std::all_of(at.begin() + 1, at.end(), [&, last = at[0]](double value) mutable {
      return std::abs(value / std::exchange(last, value) / ratio - 1) < 1e-6;
    });
    if (is_equal) return true;
  }
  constexpr double wide = 30;
  return key.highest / key.lowest >= wide;
}

void find_levels(SweepKey& key, const Json& parameter, const std::vector<double>& values) {
  if (key.is_text()) {
    for (std::size_t k = 0; k < key.texts.size(); ++k) key.places.push_back(static_cast<double>(k));
    key.highest = static_cast<double>(key.texts.size()) - 1;
    return;
  }
  std::vector<double> sorted = values;
  std::erase_if(sorted, is_none);
  if (sorted.empty()) return;
  std::sort(sorted.begin(), sorted.end());
  key.lowest = sorted.front();
  key.highest = sorted.back();
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  key.is_binned = sorted.size() > most_levels;
  if (!key.is_binned) key.places = sorted;
  key.is_log = spreads_in_ratios(parameter, key);
  if (!key.is_binned) return;
  for (std::size_t k = 0; k < bins; ++k) {
    const double share = (static_cast<double>(k) + 0.5) / bins;
    key.places.push_back(key.is_log ? key.lowest * std::pow(key.highest / key.lowest, share)
                                    : key.lowest + share * (key.highest - key.lowest));
  }
}

/// Between the two values around it, as R's type 7 and NumPy do.
double quantile(const std::vector<double>& sorted, double share) {
  if (sorted.empty()) return none;
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return values.empty() ? none : sum / static_cast<double>(values.size());
}

/// The place of a text among those there are; what is more than a picture bears goes together.
std::size_t text_level(std::vector<std::string>& texts, const std::string& text) {
  const auto place = std::find(texts.begin(), texts.end(), text);
  if (place != texts.end()) return static_cast<std::size_t>(place - texts.begin());
  if (texts.size() == most_levels) return most_levels - 1;
  texts.push_back(texts.size() + 1 < most_levels ? text : "others");
  return texts.size() - 1;
}

SweepKey key_of(const sweep::Varied& varied) {
  SweepKey key;
  key.name = varied.key;
  const bool is_pressure = is_read_in_mmhg(varied.key, varied.unit);
  key.unit = is_pressure ? "mmHg" : varied.unit;
  if (is_pressure) key.factor = 1 / mmhg;
  return key;
}

SweepQuantity quantity_of(const run::Quantity& quantity) {
  const double unit = display_unit({quantity.name(), quantity.unit(), {}, {}});
  if (unit == 1) return {quantity.name(), quantity.unit(), 1};
  return {quantity.name(), unit == mmhg ? "mmHg" : "10⁵ dyn/cm²", 1 / unit};
}

void count_failure(std::vector<SweepFailure>& failures, const sweep::Row& row) {
  auto place = std::find_if(failures.begin(), failures.end(), [&](const SweepFailure& failure) {
    return failure.reason == row.reason && failure.status == row.status;
  });
  if (place == failures.end()) {
    constexpr std::size_t most_reasons = 200;
    // Reasons that tell a time each would be as many as there are points.
    if (failures.size() >= most_reasons) {
      place = std::prev(failures.end());
      place->reason = "other reasons, which sweep.csv tells";
    } else {
      place = failures.insert(failures.end(), {row.status, row.reason, 0, {}});
    }
  }
  ++place->count;
  if (place->points.size() < most_listed) place->points.push_back(row.point);
}

}  // namespace

std::uint64_t lot_of(std::uint64_t point) {
  std::uint64_t mixed = (point + 1) * 0x9e3779b97f4a7c15ULL;
  mixed = (mixed ^ (mixed >> 30)) * 0xbf58476d1ce4e5b9ULL;
  mixed = (mixed ^ (mixed >> 27)) * 0x94d049bb133111ebULL;
  return mixed ^ (mixed >> 31);
}

std::size_t SweepKey::level(double shown) const {
  if (!is_binned) {
    const auto place = std::lower_bound(places.begin(), places.end(), shown);
    return std::min(static_cast<std::size_t>(place - places.begin()), places.size() - 1);
  }
  const double share =
      is_log ? std::log(shown / lowest) / std::log(highest / lowest) : (shown - lowest) / (highest - lowest);
  return std::min(static_cast<std::size_t>(std::max(share, 0.0) * bins), bins - 1);
}

SweepTable read_sweep(const std::filesystem::path& folder) {
  const Json campaign = sweep::read_campaign(folder);
  const sweep::Table stored = sweep::table_of(campaign, folder, sweep::Table::Mode::read);
  SweepTable table;
  table.planned = sweep::Shard{campaign.at("shard").at("index"), campaign.at("shard").at("count")}.share_of(
      campaign.at("points"));
  for (const char* status : {"done", "gave-up", "refused"}) table.ended += stored.count(status);
  table.done = stored.count("done");
  if (table.ended == 0)
    throw InvalidInput(fmt::format("{}: no point of this sweep has ended yet", folder.string()));
  for (const sweep::Varied& varied : stored.keys()) table.keys.push_back(key_of(varied));
  for (const std::string name : campaign.at("quantities"))
    table.quantities.push_back(quantity_of(run::parse_quantity(name)));
  table.key_values.resize(table.keys.size());
  table.values.resize(table.quantities.size());
  const double share = static_cast<double>(SweepTable::most_rows) / static_cast<double>(table.ended);
  const std::uint64_t threshold =
      share >= 1 ? std::numeric_limits<std::uint64_t>::max() : static_cast<std::uint64_t>(share * 0x1p64);
  const auto fidelities =
      sweep::fidelities_of(campaign.at("design"), campaign.value("tier", ""), campaign.at("points"));
  stored.each(
      [&](const sweep::Row& row) {
        const bool is_done = row.status == "done";
        if (!is_done) count_failure(table.failures, row);
        // Curves and means of several tiers together would be those of none.
        if (sweep::standing_of(fidelities, row.point).level > 0) return;
        if (lot_of(row.point) > threshold) return;
        table.numbers.push_back(row.point);
        table.is_done.push_back(is_done ? 1 : 0);
        for (std::size_t k = 0; k < table.keys.size(); ++k) {
          SweepKey& key = table.keys[k];
          if (!stored.keys()[k].unit.empty()) {
            table.key_values[k].push_back(row.keys[k].empty() ? none : std::stod(row.keys[k]) * key.factor);
            continue;
          }
          table.key_values[k].push_back(static_cast<double>(text_level(key.texts, row.keys[k])));
        }
        for (std::size_t q = 0; q < table.quantities.size(); ++q)
          table.values[q].push_back(is_done ? row.numbers[q] * table.quantities[q].factor : none);
      },
      table.quantities.size());
  for (std::size_t k = 0; k < table.keys.size(); ++k)
    find_levels(table.keys[k], campaign.at("design").at("parameters").at(k), table.key_values[k]);
  // What no point has, such as fibres' angles of walls without fibres, is no choice.
  for (std::size_t q = table.quantities.size(); q-- > 0;) {
    if (!std::all_of(table.values[q].begin(), table.values[q].end(), is_none)) continue;
    table.quantities.erase(table.quantities.begin() + static_cast<long>(q));
    table.values.erase(table.values.begin() + static_cast<long>(q));
  }
  std::stable_sort(table.failures.begin(), table.failures.end(),
                   [](const auto& a, const auto& b) { return a.count > b.count; });
  return table;
}

sweep::Row read_point(const std::filesystem::path& folder, std::uint64_t point) {
  const Json campaign = sweep::read_campaign(folder);
  const sweep::Table stored = sweep::table_of(campaign, folder, sweep::Table::Mode::read);
  sweep::Row found;
  bool is_there = false;
  stored.each([&](const sweep::Row& row) {
    if (row.point != point) return;
    found = row;
    is_there = true;
  });
  if (!is_there)
    throw InvalidInput(fmt::format("--point {}: no such row in {}; its points are numbered 0 to {}", point,
                                   folder.string(), campaign.at("points").get<std::uint64_t>() - 1));
  return found;
}

LevelSpread spread(const SweepTable& table, std::size_t key, std::size_t quantity) {
  std::vector<std::vector<double>> groups(table.keys[key].places.size());
  for (std::size_t row = 0; row < table.numbers.size(); ++row)
    if (const double value = table.values[quantity][row], at = table.key_values[key][row];
        !is_none(value) && !is_none(at))
      groups[table.keys[key].level(at)].push_back(value);
  LevelSpread found;
  for (auto& group : groups) {
    std::sort(group.begin(), group.end());
    found.count.push_back(static_cast<double>(group.size()));
    found.mean.push_back(mean(group));
    found.q05.push_back(quantile(group, 0.05));
    found.q25.push_back(quantile(group, 0.25));
    found.q50.push_back(quantile(group, 0.5));
    found.q75.push_back(quantile(group, 0.75));
    found.q95.push_back(quantile(group, 0.95));
  }
  return found;
}

std::vector<double> cell_means(const SweepTable& table, std::size_t first, std::size_t second,
                               std::size_t quantity) {
  const std::size_t width = table.keys[second].places.size();
  std::vector<double> sums(table.keys[first].places.size() * width, 0), counts(sums.size(), 0);
  for (std::size_t row = 0; row < table.numbers.size(); ++row) {
    const double value = table.values[quantity][row];
    const double at = table.key_values[first][row], beside = table.key_values[second][row];
    if (is_none(value) || is_none(at) || is_none(beside)) continue;
    const std::size_t cell = table.keys[first].level(at) * width + table.keys[second].level(beside);
    sums[cell] += value;
    ++counts[cell];
  }
  for (std::size_t cell = 0; cell < sums.size(); ++cell)
    sums[cell] = counts[cell] > 0 ? sums[cell] / counts[cell] : none;
  return sums;
}

}  // namespace tunica::report
