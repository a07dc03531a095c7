// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/sweep/surrogate_table.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/error.hpp"
#include "core/observables/result.hpp"
#include "verification/sweep/campaign.hpp"
#include "verification/sweep/fidelity_points.hpp"
#include "verification/uncertainty/surrogate.hpp"

namespace tunica::sweep {

namespace {

using Json = nlohmann::ordered_json;
using Eigen::Index;
using uncertainty::Coordinate;
using uncertainty::Validated;

constexpr double none = observables::none;

/// The done points of a sweep, by their places in the sample.
struct Sample {
  std::vector<std::string> keys;
  std::vector<NumberColumn> quantities;
  std::vector<std::string> tiers;
  std::vector<Coordinate> coordinates;
  Eigen::MatrixXd places;                                ///< [point][key]
  std::vector<std::vector<std::vector<double>>> values;  ///< [quantity][tier][point]
  std::vector<std::vector<char>> is_done;                ///< [tier][point]
  std::uint64_t lost = 0;                                ///< points without a result

  std::size_t done(std::size_t tier) const {
    return static_cast<std::size_t>(std::count(is_done[tier].begin(), is_done[tier].end(), 1));
  }
};

Sample read_sample(const Json& campaign, const std::filesystem::path& folder) {
  const Table table = table_of(campaign, folder, Table::Mode::read);
  const Json& design = campaign.at("design");
  const auto fidelities = fidelities_of(design, campaign.at("tier"), campaign.at("points"));
  Sample sample;
  for (const Json& parameter : design.at("parameters")) {
    const std::string key = parameter.at("key");
    const auto law = uncertainty::parse_marginal(parameter.value("distribution", std::string()), key,
                                                 parameter.at("unit"));
    if (!law) throw InvalidInput(fmt::format("{}: {} has no distribution", folder.string(), key));
    sample.keys.push_back(key);
    sample.coordinates.emplace_back(*law);
  }
  const std::size_t quantities = campaign.at("quantities").size(), inputs = sample.keys.size();
  sample.quantities.assign(table.numbers().begin(),
                           table.numbers().begin() + static_cast<std::ptrdiff_t>(quantities));
  const auto points = std::min<std::uint64_t>(fidelities.front().points, uncertainty::most_points);
  sample.places = Eigen::MatrixXd::Zero(static_cast<Index>(points), static_cast<Index>(inputs));
  for (const Fidelity& fidelity : fidelities) sample.tiers.push_back(fidelity.tier);
  sample.values.assign(quantities, std::vector(fidelities.size(), std::vector<double>(points, none)));
  sample.is_done.assign(fidelities.size(), std::vector<char>(points, 0));
  table.each([&](const Row& row) {
    const Standing at = standing_of(fidelities, row.point);
    if (at.point >= points) return;
    if (row.status != run::name_of(run::Ending::done)) {
      ++sample.lost;
      return;
    }
    sample.is_done[at.level][at.point] = 1;
    for (std::size_t k = 0; k < inputs; ++k)
      sample.places(static_cast<Index>(at.point), static_cast<Index>(k)) =
          sample.coordinates[k].of(std::stod(row.keys[k]));
    for (std::size_t q = 0; q < quantities; ++q) sample.values[q][at.level][at.point] = row.numbers[q];
  });
  return sample;
}

/// What is found of one quantity.
struct Finding {
  Json told;
  std::optional<std::vector<uncertainty::SobolIndices>> indices;
  std::string poor;  ///< why it is, empty when it is good
};

Json interval(const uncertainty::Estimate& estimate) {
  return {{"value", estimate.value}, {"low", estimate.low}, {"high", estimate.high}};
}

std::size_t known(const std::vector<double>& values) {
  return static_cast<std::size_t>(
      std::count_if(values.begin(), values.end(), [](double value) { return !std::isnan(value); }));
}

/// Why there can be no surrogate; empty when there can. A quantity that no point has needs no reason.
std::string obstacle(const Sample& sample, std::size_t quantity) {
  constexpr double most_unknown = 0.1;
  const auto fewest = static_cast<std::size_t>(uncertainty::fewest_points(sample.places.cols()));
  for (std::size_t tier = 0; tier < sample.tiers.size(); ++tier) {
    const std::size_t done = sample.done(tier), found = known(sample.values[quantity][tier]);
    const std::string by = sample.tiers.size() > 1 ? " by " + sample.tiers[tier] : "";
    if (found < fewest)
      return fmt::format("has a value at {} points{}, and a surrogate needs {}", found, by, fewest);
    if (static_cast<double>(done - found) > most_unknown * static_cast<double>(done))
      return fmt::format("has no value at {} of {} points{}", done - found, done, by);
  }
  return {};
}

Finding find(const Sample& sample, std::size_t quantity) {
  constexpr double good = 0.9, useless = 0.5;
  const auto& levels = sample.values[quantity];
  Finding finding{{{"quantity", sample.quantities[quantity].name}}, {}, {}};
  if (known(levels.back()) == 0) {
    finding.told["reason"] = "no point has it";
    return finding;
  }
  finding.poor = obstacle(sample, quantity);
  Validated found;
  if (finding.poor.empty()) {
    if (levels.size() > 1) {
      found = uncertainty::fit_fidelities(sample.coordinates, sample.places, levels);
    } else {
      std::vector<Index> points;
      for (std::size_t i = 0; i < levels[0].size(); ++i)
        if (!std::isnan(levels[0][i])) points.push_back(static_cast<Index>(i));
      const Eigen::Map<const Eigen::VectorXd> values(levels[0].data(), static_cast<Index>(levels[0].size()));
      found =
          uncertainty::fit_surrogate({sample.coordinates, sample.places(points, Eigen::all), values(points)});
    }
    if (!found.surrogate) {
      finding.told["reason"] = "does not vary";
      return finding;
    }
    finding.told["kind"] = found.surrogate->kind();
    if (levels.size() > 1) finding.told["tiers"] = found.sums_levels ? "all" : sample.tiers.back();
    finding.told["q2"] = found.q2;
    finding.told["points"] = found.residuals.size();
    if (found.q2 < good)
      finding.poor =
          fmt::format("its surrogate misses {:.0f} % of the variance", 100 * std::min(1.0, 1 - found.q2));
  }
  if (!finding.poor.empty()) finding.told["reason"] = finding.poor;
  if (!found.surrogate || found.q2 < useless) return finding;
  finding.told["mean"] = interval(uncertainty::surrogate_mean(found));
  finding.told["standard_deviation"] = std::sqrt(found.surrogate->variance());
  finding.indices = uncertainty::surrogate_indices(found);
  return finding;
}

/// A line of fidelities.csv; empty where no point has both.
std::string compared(const Sample& sample, std::size_t quantity, std::size_t dear) {
  const auto &one = sample.values[quantity].front(), &other = sample.values[quantity][dear];
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest, sum = 0, largest = 0;
  std::size_t points = 0, largest_at = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    const double difference = other[i] - one[i];
    if (std::isnan(difference)) continue;
    lowest = std::min({lowest, one[i], other[i]});
    highest = std::max({highest, one[i], other[i]});
    sum += difference;
    if (++points == 1 || std::abs(difference) > std::abs(largest)) {
      largest = difference;
      largest_at = i;
    }
  }
  if (points == 0) return {};
  constexpr double much = 0.05;
  const auto beyond = std::count_if(one.begin(), one.end(), [&](const double& value) {
    return std::abs(other[static_cast<std::size_t>(&value - one.data())] - value) > much * (highest - lowest);
  });
  return fmt::format("{},{},{},{},{},{},{},{},{},{}\n", sample.quantities[quantity].name,
                     sample.quantities[quantity].unit, sample.tiers.front(), sample.tiers[dear], points,
                     value_text(highest - lowest), value_text(sum / static_cast<double>(points)),
                     value_text(largest), largest_at, beyond);
}

void write_comparison(const Sample& sample, const std::filesystem::path& folder) {
  std::string text =
      "quantity,unit,cheap,dear,points,range,mean_difference,largest_difference,largest_at,"
      "beyond_5_percent\n";
  for (std::size_t quantity = 0; quantity < sample.quantities.size(); ++quantity)
    for (std::size_t dear = 1; dear < sample.tiers.size(); ++dear) text += compared(sample, quantity, dear);
  write_whole(folder / fidelities_file, text);
}

}  // namespace

bool makes_surrogates(const Json& campaign) {
  return campaign.value("made_of_points", Json()) == "surrogates";
}

IndexSummary write_surrogates(const std::filesystem::path& folder, const std::function<bool()>& interrupted) {
  Json campaign = read_campaign(folder);
  const Sample sample = read_sample(campaign, folder);
  std::vector<Finding> findings(sample.quantities.size());
  tbb::parallel_for(std::size_t{0}, findings.size(), [&](std::size_t quantity) {
    if (!interrupted()) findings[quantity] = find(sample, quantity);
  });
  IndexSummary summary;
  summary.interrupted = interrupted();
  if (summary.interrupted) return summary;
  summary.lost = sample.lost;
  summary.points = sample.done(sample.tiers.size() - 1);
  std::string text = index_head();
  Json told = Json::array();
  for (std::size_t quantity = 0; quantity < findings.size(); ++quantity) {
    const Finding& finding = findings[quantity];
    const std::string& name = sample.quantities[quantity].name;
    if (!finding.poor.empty()) {
      summary.poor.push_back(fmt::format("{}: {}", name, finding.poor));
      // More points may make it better.
      if (!finding.indices) summary.widest = std::numeric_limits<double>::infinity();
    }
    for (std::size_t k = 0; k < sample.keys.size(); ++k) {
      const uncertainty::SobolIndices indices =
          finding.indices ? (*finding.indices)[k]
                          : uncertainty::SobolIndices{{none, none, none}, {none, none, none}};
      text += index_line(name, sample.keys[k], indices);
      for (const auto& estimate : {indices.first, indices.total})
        if (finding.indices) summary.widest = std::max(summary.widest, estimate.high - estimate.low);
    }
    told.push_back(finding.told);
  }
  campaign["surrogates"] = std::move(told);
  campaign["intervals"] = "95 %, with what the surrogates miss";
  write_whole(folder / indices_file, text);
  if (sample.tiers.size() > 1) write_comparison(sample, folder);
  write_whole(folder / campaign_file, campaign.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  return summary;
}

}  // namespace tunica::sweep
