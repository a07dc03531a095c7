// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/sweep/index_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/error.hpp"
#include "verification/sweep/campaign.hpp"
#include "verification/sweep/surrogate_table.hpp"
#include "verification/uncertainty/indices.hpp"

namespace tunica::sweep {

namespace {

using uncertainty::PickFreeze;

PickFreeze empty_outputs(std::size_t inputs, std::size_t groups) {
  const std::vector<double> nothing(groups, observables::none);
  return {nothing, nothing, std::vector<std::vector<double>>(inputs, nothing)};
}

void put(PickFreeze& outputs, std::uint64_t point, double value) {
  const std::uint64_t size = outputs.mixed.size() + 2, group = point / size, place = point % size;
  (place == 0 ? outputs.a : place == 1 ? outputs.b : outputs.mixed[place - 2])[group] = value;
}

std::string cell(double value) {
  return observables::is_none(value) ? "" : value_text(value);
}

}  // namespace

bool has_indices(const std::filesystem::path& folder) {
  const auto campaign = read_campaign(folder);
  return campaign.at("design").contains("pick_freeze") || makes_surrogates(campaign);
}

std::string index_head() {
  return "quantity,parameter,first,first_low,first_high,total,total_low,total_high\n";
}

std::string index_line(const std::string& quantity, const std::string& key,
                       const uncertainty::SobolIndices& indices) {
  const auto& [one, all] = indices;
  return fmt::format("{},{},{},{},{},{},{},{}\n", quantity, key, cell(one.value), cell(one.low),
                     cell(one.high), cell(all.value), cell(all.low), cell(all.high));
}

IndexSummary write_indices(const std::filesystem::path& folder, const std::function<bool()>& interrupted) {
  const auto campaign = read_campaign(folder);
  if (makes_surrogates(campaign)) return write_surrogates(folder, interrupted);
  if (!campaign.at("design").contains("pick_freeze"))
    throw InvalidInput(
        fmt::format("{}: no sample for Sobol' indices; make one with --indices", folder.string()));
  const Table table = table_of(campaign, folder, Table::Mode::read);
  const std::size_t inputs = table.keys().size(), quantities = campaign.at("quantities").size();
  const std::uint64_t points = campaign.at("points"), groups = points / (inputs + 2);
  IndexSummary summary{0, groups};
  std::string text = index_head();
  // Quantities are gone through in batches, so that memory does not grow with both their number and the
  // points'.
  constexpr std::uint64_t most_numbers = 8'000'000;
  const std::size_t batch =
      std::max<std::size_t>(1, static_cast<std::size_t>(most_numbers / std::max<std::uint64_t>(points, 1)));
  for (std::size_t first = 0; first < quantities; first += batch) {
    const std::size_t end = std::min(quantities, first + batch);
    std::vector<PickFreeze> outputs(end - first, empty_outputs(inputs, groups));
    std::uint64_t done = 0;
    table.each([&](const Row& row) {
      if (row.status != run::name_of(run::Ending::done) || row.point >= points) return;
      ++done;
      for (std::size_t q = first; q < end; ++q) put(outputs[q - first], row.point, row.numbers[q]);
    });
    for (std::size_t q = first; q < end; ++q) {
      const PickFreeze& of = outputs[q - first];
      const auto found = uncertainty::sobol_indices(of);
      const std::uint64_t whole = uncertainty::whole_groups(of);
      // Of a quantity that no point has, as fibres of a law without any, nothing is lost.
      if (whole > 0) summary.lost = std::max(summary.lost, groups - whole);
      constexpr double unknown = std::numeric_limits<double>::infinity();
      if (whole > 0 && whole < uncertainty::fewest_groups) summary.widest = unknown;
      for (std::size_t k = 0; k < inputs; ++k) {
        const auto& [one, all] = found[k];
        text += index_line(table.numbers()[q].name, table.keys()[k].key, found[k]);
        if (observables::is_none(one.value)) continue;
        for (const auto& estimate : {one, all})
          summary.widest = observables::is_none(estimate.low)
                               ? unknown
                               : std::max(summary.widest, estimate.high - estimate.low);
      }
    }
  }
  write_whole(folder / indices_file, text);
  return summary;
}

}  // namespace tunica::sweep
