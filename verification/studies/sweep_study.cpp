// SPDX-License-Identifier: GPL-3.0-or-later
// What governs the paper's artery: outlet resistance, tether stiffness and activation stretch vary, by 0D at
// 10,240 points and by 2D at 200. Tables and pictures of docs/verification/sweep-study.md, also as CSV.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/observables/build_info.hpp"
#include "core/observables/result.hpp"
#include "core/threads.hpp"
#include "core/units.hpp"
#include "verification/line_chart.hpp"
#include "verification/page.hpp"
#include "verification/studies/study.hpp"
#include "verification/sweep/campaign.hpp"
#include "verification/sweep/fidelity_points.hpp"
#include "verification/sweep/index_table.hpp"
#include "verification/sweep/surrogate_table.hpp"
#include "verification/uncertainty/surrogate.hpp"

using namespace tunica;
using namespace tunica::verification;

namespace {

constexpr std::uint64_t groups = 2048, cheap_points = 2000, dear_points = 200;

struct Key {
  const char *name, *law, *label;
};
constexpr Key keys[] = {{"outlet.resistance", "5.16e5:2.064e6:log", "R"},
                        {"tether.stiffness", "3e6:3e7:log", "K"},
                        {"wall.activation_stretch", "1.2:1.7", "a"}};

/// A quantity as people read it.
struct Asked {
  const char *name, *about, *unit;
  double factor;
};
const Asked asked[] = {{"pressure.max", "peak pressure", "mmHg", 1 / mmhg},
                       {"pressure.min", "lowest pressure", "mmHg", 1 / mmhg},
                       {"radial_displacement.P1.max", "peak displacement of the lumen", "µm", 1e4},
                       {"radial_displacement.P1.change", "change of the displacement in a beat", "µm", 1e4},
                       {"von_mises.max", "peak von Mises stress", "10⁵ dyn/cm²", 1e-5},
                       {"fiber_angle.P1.change", "change of the fibre angle at the lumen", "°", 1},
                       {"recruitment.P1.share", "recruited share of the beat, at the lumen", "%", 100},
                       {"recruitment.P4.share", "recruited share, at the outer surface", "%", 100}};

std::vector<sweep::Axis> axes() {
  std::vector<sweep::Axis> all;
  for (const Key& key : keys) all.push_back(sweep::parse_axis(fmt::format("{}={}", key.name, key.law)));
  return all;
}

/// The same computation as `tunica sweep` makes; goes on where it has stopped.
void compute(const Study& study, sweep::Points& points, const std::string& tier, bool surrogates,
             const std::string& name) {
  const auto folder = study.kept(name);
  const run::Door door = study.door({"", "cylinder", tier, {}, {}}, {});
  run::Question question;
  for (const Asked& one : asked) question.quantities.push_back(run::parse_quantity(one.name));
  sweep::Campaign campaign{door,  tier,  points, question,  {}, available_threads(),
                           false, false, {},     surrogates};
  sweep::SweepControl control;
  control.resume =
      sweep::holds_sweep(folder) && sweep::read_campaign(folder).value("commit", "") == program_commit();
  control.replace = !control.resume;
  const auto summary = sweep::run_sweep(campaign, folder, control);
  fmt::print(stderr, "{}: {} points, {} without a result, {:.0f} s of one processor\n", name, summary.count,
             summary.gave_up + summary.refused, summary.seconds);
  sweep::write_indices(folder);
}

/// A folder's table: values of keys and quantities by tier and point of the sample; none without a result.
struct Read {
  std::vector<std::vector<std::vector<double>>> keys, quantities;  ///< [tier][of it][point]
};
Read read(const std::filesystem::path& folder) {
  const auto campaign = sweep::read_campaign(folder);
  const auto table = sweep::table_of(campaign, folder, sweep::Table::Mode::read);
  const auto fidelities =
      sweep::fidelities_of(campaign.at("design"), campaign.at("tier"), campaign.at("points"));
  Read found;
  for (const auto& fidelity : fidelities) {
    found.keys.emplace_back(std::size(keys), std::vector<double>(fidelity.points, observables::none));
    found.quantities.emplace_back(std::size(asked), std::vector<double>(fidelity.points, observables::none));
  }
  table.each([&](const sweep::Row& row) {
    const auto at = sweep::standing_of(fidelities, row.point);
    for (std::size_t k = 0; k < std::size(keys); ++k)
      found.keys[at.level][k][at.point] = std::stod(row.keys[k]);
    if (row.status != run::name_of(run::Ending::done)) return;
    for (std::size_t q = 0; q < std::size(asked); ++q)
      found.quantities[at.level][q][at.point] = row.numbers[q] * asked[q].factor;
  });
  return found;
}

/// indices.csv: the six numbers of "quantity,key"; none for empty cells.
std::map<std::string, std::vector<double>> indices(const std::filesystem::path& folder) {
  const auto table = observables::read_csv((folder / sweep::indices_file).string());
  std::map<std::string, std::vector<double>> found;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    auto& numbers = found[table.find("quantity")->labels[row] + "," + table.find("parameter")->labels[row]];
    for (const char* column : {"first", "first_low", "first_high", "total", "total_low", "total_high"}) {
      const std::string& text = table.find(column)->labels[row];
      numbers.push_back(text.empty() ? observables::none : std::stod(text));
    }
  }
  return found;
}

std::string share(double value, double low, double high) {
  if (observables::is_none(value)) return "–";
  return fmt::format("{:.2f} ({:.2f}–{:.2f})", value, std::max(0.0, low), std::min(1.0, high));
}

std::string index_table(const std::filesystem::path& folder) {
  const auto found = indices(folder);
  std::vector<std::string> header{"quantity"};
  for (const Key& key : keys)
    header.insert(header.end(), {fmt::format("{}: first", key.label), fmt::format("{}: total", key.label)});
  std::vector<std::vector<std::string>> rows;
  for (const Asked& one : asked) {
    rows.push_back({one.about});
    for (const Key& key : keys) {
      const auto& n = found.at(fmt::format("{},{}", one.name, key.name));
      rows.back().push_back(share(n[0], n[1], n[2]));
      rows.back().push_back(share(n[3], n[4], n[5]));
    }
  }
  return markdown_table(header, rows);
}

/// Of the 2D tier: how much each quantity varies, and how well that is known.
std::string size_table(const std::filesystem::path& folder, const Read& found) {
  const auto campaign = sweep::read_campaign(folder);
  std::vector<std::vector<std::string>> rows;
  for (std::size_t q = 0; q < std::size(asked); ++q) {
    const auto& told = campaign.at("surrogates").at(q);
    std::vector<double> values;
    for (const double value : found.quantities[1][q])
      if (!observables::is_none(value)) values.push_back(value);
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    const double factor = asked[q].factor;
    const bool has = told.contains("mean");
    const auto number = [&](const char* name) { return factor * told.at("mean").at(name).get<double>(); };
    rows.push_back(
        {fmt::format("{}, {}", asked[q].about, asked[q].unit), fmt::format("{:.4g}", *least),
         fmt::format("{:.4g}", *most),
         has ? fmt::format("{:.4g} ({:.4g}–{:.4g})", number("value"), number("low"), number("high")) : "–",
         has ? fmt::format("{:.3g}", factor * told.at("standard_deviation").get<double>()) : "–",
         told.contains("q2") ? fmt::format("{:.4f}", told.at("q2").get<double>()) : "–"});
  }
  return markdown_table({"quantity", "least", "most", "mean (95 % interval)", "standard deviation", "Q²"},
                        rows);
}

/// Differences of the two tiers at the points that both have, as shares of the range of both.
struct Difference {
  std::vector<double> shares;  ///< by point; none without both
  double range = 0;
};
Difference difference(const Read& found, std::size_t q) {
  Difference all;
  double least = INFINITY, most = -INFINITY;
  const auto &cheap = found.quantities[0][q], &dear = found.quantities[1][q];
  for (std::size_t i = 0; i < dear.size(); ++i) {
    all.shares.push_back(dear[i] - cheap[i]);
    if (observables::is_none(all.shares.back())) continue;
    least = std::min({least, cheap[i], dear[i]});
    most = std::max({most, cheap[i], dear[i]});
  }
  all.range = most - least;
  for (double& value : all.shares) value /= all.range;
  return all;
}

std::string key_values(const Read& found, std::size_t point) {
  return fmt::format("R {:.3g}, K {:.3g}, a {:.3f}", found.keys[1][0][point], found.keys[1][1][point],
                     found.keys[1][2][point]);
}

std::string tier_table(const Read& found) {
  const auto all = axes();
  std::vector<uncertainty::Coordinate> coordinates;
  for (const auto& axis : all) coordinates.emplace_back(*axis.marginal);
  std::vector<std::vector<std::string>> rows;
  for (std::size_t q = 0; q < std::size(asked); ++q) {
    const Difference of = difference(found, q);
    std::vector<std::size_t> points;
    for (std::size_t i = 0; i < of.shares.size(); ++i)
      if (!observables::is_none(of.shares[i])) points.push_back(i);
    const auto rows_of = static_cast<Eigen::Index>(points.size());
    Eigen::MatrixXd places(rows_of, std::size(keys));
    Eigen::VectorXd values(rows_of);
    for (Eigen::Index i = 0; i < rows_of; ++i) {
      const std::size_t point = points[static_cast<std::size_t>(i)];
      values[i] = of.shares[point];
      for (std::size_t k = 0; k < std::size(keys); ++k)
        places(i, static_cast<Eigen::Index>(k)) = coordinates[k].of(found.keys[1][k][point]);
    }
    const auto larger = [&](std::size_t a, std::size_t b) {
      return std::abs(of.shares[a]) < std::abs(of.shares[b]);
    };
    const std::size_t worst = *std::max_element(points.begin(), points.end(), larger);
    const auto beyond = std::count_if(points.begin(), points.end(),
                                      [&](std::size_t i) { return std::abs(of.shares[i]) > 0.05; });
    const auto surrogate = uncertainty::fit_surrogate({coordinates, places, values});
    std::string governs = "–";
    if (surrogate.surrogate && surrogate.q2 > 0.5) {
      const auto by = uncertainty::surrogate_indices(surrogate);
      governs.clear();
      for (std::size_t k = 0; k < std::size(keys); ++k)
        governs += fmt::format("{}{} {:.2f}", k > 0 ? ", " : "", keys[k].label, by[k].total.value);
    }
    rows.push_back({asked[q].about, fmt::format("{:+.2f}", 100 * values.mean()),
                    fmt::format("{:+.2f}", 100 * of.shares[worst]), key_values(found, worst),
                    fmt::format("{} of {}", beyond, points.size()), governs});
  }
  return markdown_table({"quantity", "mean difference, % of range", "largest", "at", "beyond 5 %",
                         "what governs it (total indices)"},
                        rows);
}

/// Q2 of the 2D tier from its first points alone, as told by cross-validation and true at all points behind
/// the first hundred, and the same with those of 0D.
std::string fewer_table(const Read& found) {
  constexpr std::size_t fresh = 100;
  const auto all = axes();
  std::vector<uncertainty::Coordinate> coordinates;
  for (const auto& axis : all) coordinates.emplace_back(*axis.marginal);
  Eigen::MatrixXd places(cheap_points, std::size(keys));
  for (std::size_t i = 0; i < cheap_points; ++i)
    for (std::size_t k = 0; k < std::size(keys); ++k)
      places(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          coordinates[k].of(found.keys[0][k][i]);
  std::vector<std::vector<std::string>> rows;
  for (std::size_t q = 0; q < std::size(asked); ++q) {
    const auto& dear = found.quantities[1][q];
    const auto true_q2 = [&](const uncertainty::Surrogate& surrogate) {
      std::vector<double> values, missed;
      for (std::size_t i = fresh; i < dear.size(); ++i) {
        if (observables::is_none(dear[i])) continue;
        values.push_back(dear[i]);
        missed.push_back(dear[i] - surrogate.value(places.row(static_cast<Eigen::Index>(i))));
      }
      const auto count = static_cast<Eigen::Index>(values.size());
      const Eigen::Map<const Eigen::ArrayXd> f(values.data(), count), e(missed.data(), count);
      return 1 - e.square().sum() / (f - f.mean()).square().sum();
    };
    rows.push_back({asked[q].about});
    for (const std::size_t few : {std::size_t{20}, std::size_t{40}}) {
      std::vector<std::vector<double>> levels{found.quantities[0][q],
                                              std::vector<double>(cheap_points, observables::none)};
      std::copy_n(dear.begin(), few, levels[1].begin());
      const std::vector<std::vector<double>> alone{levels[1]};
      for (const auto& of : {alone, levels}) {
        const auto surrogate = uncertainty::fit_fidelities(coordinates, places, of);
        rows.back().push_back(fmt::format("{:.3f} ({:.3f})", surrogate.q2, true_q2(*surrogate.surrogate)));
      }
    }
  }
  return markdown_table(
      {"quantity", "20 in 2D alone", "20, and 2,000 in 0D", "40 in 2D alone", "40, and 2,000 in 0D"}, rows);
}

/// The quantities over the key that governs them most, by both tiers at the points of the 2D tier.
std::string picture_of_quantities(const Read& found, const std::filesystem::path& folder) {
  const auto by = indices(folder);
  std::vector<LineChart> charts;
  for (std::size_t q = 0; q < std::size(asked); ++q) {
    std::size_t governing = 0;
    const auto total = [&](std::size_t k) {
      return by.at(fmt::format("{},{}", asked[q].name, keys[k].name))[3];
    };
    for (std::size_t k = 1; k < std::size(keys); ++k)
      if (total(k) > total(governing)) governing = k;
    LineChart chart;
    chart.title = asked[q].about;
    chart.x_label =
        fmt::format("{}, {}", keys[governing].name, sweep::unit_of(keys[governing].name, "--vary"));
    chart.y_label = asked[q].unit;
    chart.log_x = governing < 2;
    for (const std::size_t tier : {std::size_t{0}, std::size_t{1}}) {
      Series series{tier == 0 ? "0D" : "2D", {}, {}, false, true};
      for (std::size_t i = 0; i < dear_points; ++i) {
        const double value = found.quantities[tier][q][i];
        if (observables::is_none(value)) continue;
        series.x.push_back(found.keys[1][governing][i]);
        series.y.push_back(value);
      }
      chart.series.push_back(std::move(series));
    }
    charts.push_back(std::move(chart));
  }
  return svg(charts, 2);
}

/// How far 2D is from 0D, over the largest opening of the lumen.
std::string picture_of_differences(const Read& found) {
  constexpr std::size_t opening = 2;
  std::vector<LineChart> charts;
  for (std::size_t q = 0; q < std::size(asked); ++q) {
    const Difference of = difference(found, q);
    LineChart chart{asked[q].about, "peak displacement, µm", "2D less 0D, % of range", {}};
    Series series{"2D less 0D", {}, {}, false, true};
    for (std::size_t i = 0; i < of.shares.size(); ++i) {
      if (observables::is_none(of.shares[i])) continue;
      series.x.push_back(found.quantities[0][opening][i]);
      series.y.push_back(100 * of.shares[i]);
    }
    chart.series.push_back(std::move(series));
    charts.push_back(std::move(chart));
  }
  return svg(charts, 2);
}

std::string points_csv(const Read& found) {
  std::string text = "point,tier";
  for (const Key& key : keys) text += fmt::format(",{}[{}]", key.name, sweep::unit_of(key.name, "--vary"));
  for (const Asked& one : asked)
    text += fmt::format(",{}[{}]", one.name, run::parse_quantity(one.name).unit());
  text += '\n';
  for (std::size_t i = 0; i < dear_points; ++i)
    for (const std::size_t tier : {std::size_t{0}, std::size_t{1}}) {
      text += fmt::format("{},{}", i, tier == 0 ? "lumped" : "axisym");
      for (std::size_t k = 0; k < std::size(keys); ++k)
        text += fmt::format(",{:.8g}", found.keys[tier][k][i]);
      for (std::size_t q = 0; q < std::size(asked); ++q) {
        const double value = found.quantities[tier][q][i] / asked[q].factor;
        text += observables::is_none(value) ? "," : fmt::format(",{:.6g}", value);
      }
      text += '\n';
    }
  return text;
}

std::string indices_csv(const std::filesystem::path& direct, const std::filesystem::path& both) {
  std::string text = "tier,quantity,parameter,first,first_low,first_high,total,total_low,total_high\n";
  for (const auto& [tier, folder] : {std::pair{"lumped", direct}, std::pair{"axisym", both}})
    for (const auto& [name, numbers] : indices(folder)) {
      text += fmt::format("{},{}", tier, name);
      for (const double number : numbers)
        text += observables::is_none(number) ? "," : fmt::format(",{:.4f}", number);
      text += '\n';
    }
  return text;
}

}  // namespace

void tunica::verification::sweep_study(const Study& study) {
  const Page page(study.out("docs/verification/sweep-study.md"), "tables", "tools/study sweep");
  const auto direct = sweep::pick_freeze_points(axes(), uncertainty::Sampling::sobol, groups, 0);
  compute(study, *direct, "lumped", false, "0d");
  const auto both =
      sweep::fidelity_points(sweep::sample_points(axes(), uncertainty::Sampling::sobol, cheap_points, 0),
                             {{"lumped", cheap_points}, {"axisym", dear_points}});
  compute(study, *both, "lumped,axisym", true, "both");
  const Read found = read(study.kept("both"));
  page.write("### Indices of the 2D tier\n\n" + index_table(study.kept("both")) +
             "### Indices of the 0D tier, by 10,240 points\n\n" + index_table(study.kept("0d")) +
             "### The quantities in 2D\n\n" + size_table(study.kept("both"), found) + "### 2D less 0D\n\n" +
             tier_table(found) +
             "### Fewer points in 2D: Q² as told, and in brackets as it is at 99 other points\n\n" +
             fewer_table(found));
  write_whole(study.out("docs/images/sweep-study.svg"), picture_of_quantities(found, study.kept("both")));
  write_whole(study.out("docs/images/sweep-study-tiers.svg"), picture_of_differences(found));
  write_whole(study.out("notebooks_data/sweep_points.csv"), points_csv(found));
  write_whole(study.out("notebooks_data/sweep_indices.csv"),
              indices_csv(study.kept("0d"), study.kept("both")));
}
