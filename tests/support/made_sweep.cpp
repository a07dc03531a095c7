// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/made_sweep.hpp"

#include <cmath>

#include <nlohmann/json.hpp>

#include "core/observables/result.hpp"
#include "core/units.hpp"
#include "verification/sweep/campaign.hpp"

namespace tunica::test_support {

void make_sweep(const std::filesystem::path& folder, const MadeSweep& made) {
  constexpr int laws = 2, stiffnesses = 3;
  const char* law[laws] = {"EXP1", "EXP2"};
  std::filesystem::create_directories(folder);
  run::Question question;
  for (const char* name : {"pressure.max", "radial_displacement.P1.change", "fiber_angle.P1.change"})
    question.quantities.push_back(run::parse_quantity(name));
  const std::vector<sweep::Varied> keys{
      {"outlet.resistance", "dyn s/cm5"}, {"wall.law", ""}, {"tether.stiffness", "dyn/cm3"}};
  sweep::Table table(folder / sweep::database_file, sweep::Table::Mode::create, keys,
                     sweep::number_columns(question));
  const std::uint64_t count = static_cast<std::uint64_t>(made.many) * laws * stiffnesses;
  for (std::uint64_t point = 0; point < count; ++point) {
    const double i = static_cast<double>(point / (laws * stiffnesses));
    const std::size_t j = point / stiffnesses % laws;
    const double k = static_cast<double>(point % stiffnesses);
    sweep::Row row;
    row.point = point;
    row.status = "done";
    row.tier = "lumped";
    row.keys = {sweep::value_text(5e5 * std::pow(4.0, i / (made.many - 1))), law[j],
                sweep::value_text(1e7 * (1 + k))};
    row.numbers = {(60 + 10 * i + k) * mmhg, 1e-3 * (1 + k), observables::none};
    if (point == count - 1) {
      row.status = "gave-up";
      row.reason = made.reason;
      row.numbers.clear();
    }
    table.insert(row);
  }
  using Json = nlohmann::ordered_json;
  Json parameters = Json::array();
  for (const auto& [key, unit] : keys) parameters.push_back({{"key", key}, {"unit", unit}});
  Json campaign{{"program", "tunica sweep"},
                {"scene", made.reason},
                {"tier", "lumped"},
                {"design", {{"kind", "list"}, {"parameters", parameters}}},
                {"points", count},
                {"shard", {{"index", 1}, {"count", 1}}},
                {"timings", false},
                {"counts", {{"done", count - 1}, {"gave-up", 1}, {"refused", 0}}},
                {"quantities", {"pressure.max", "radial_displacement.P1.change", "fiber_angle.P1.change"}},
                {"gradients", Json::array()},
                {"scene_toml", made.reason}};
  if (made.with_indices)
    campaign["surrogates"] = {
        {{"quantity", "pressure.max"}, {"kind", "kriging"}, {"q2", 0.98765}, {"points", count - 1}},
        {{"quantity", "radial_displacement.P1.change"}, {"reason", "too <few> points"}}};
  write_whole(folder / sweep::campaign_file, campaign.dump());
  if (made.with_indices)
    write_whole(folder / "indices.csv",
                "quantity,parameter,first,first_low,first_high,total,total_low,total_high\n"
                "pressure.max,outlet.resistance,0.9,0.85,0.95,0.92,0.9,0.96\n"
                "pressure.max,wall.law,0,-0.02,0.02,0.01,0,0.03\n"
                "pressure.max,tether.stiffness,0.08,0.05,0.11,0.1,0.06,0.12\n");
}

}  // namespace tunica::test_support
