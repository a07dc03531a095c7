// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/studies/ripple_tables.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "core/radial/from_scene.hpp"
#include "core/stability/half_space.hpp"
#include "core/stability/scan.hpp"
#include "core/units.hpp"

namespace tunica::verification {

using stability::base_state;
using stability::BaseState;
using stability::HalfSpace;
using stability::Ripple;
using stability::Scan;
using stability::Strip;
using stability::UnstableRange;

namespace {

constexpr double h = 0.01, density = 1.2;
constexpr double least_pressure = 0.1 * mmhg, greatest_pressure = 200 * mmhg;
const std::vector<std::string> laws{"EXP1", "EXP2", "EXP1+EXP2-ZS", "EXP1+EXP2-FS"};
const std::vector<std::string> soft_laws{"EXP2", "EXP1+EXP2-FS"};
const std::vector<double> shares{0.05, 0.1, 0.25, 0.5, 1, 2, 3, 5, 8};

using Model = std::unique_ptr<const radial::RingModel>;

Model wall(const std::string& law, const std::string& tether, std::vector<std::string> overrides = {}) {
  overrides.insert(overrides.end(), {"wall.law=" + law, "tether.traction=" + tether});
  return radial::ring_model(parse_scene("[wall]\n", "the paper's wall", ".", overrides), {});
}

double wave_number(double share) {
  return 2 * std::numbers::pi / (share * h);
}

std::vector<double> all_waves() {
  return stability::wave_lengths(0.05 * h, 100 * h, 34);
}

template <class Search>
std::vector<UnstableRange> ranges(const Model& model, const Search& search,
                                  stability::Resolution resolution = {}) {
  const Scan scan{least_pressure, greatest_pressure, 100, 1e-5, resolution};
  return unstable_ranges(*model, scan, search);
}

std::vector<UnstableRange> ranges_of(const Model& model, const std::vector<double>& lengths, int around = 0,
                                     stability::Resolution resolution = {}) {
  return ranges(
      model,
      [&](const BaseState& base) {
        const Strip strip(base, around);
        std::vector<Ripple> unstable;
        for (const double length : lengths)
          if (!strip.is_stable(2 * std::numbers::pi / length)) unstable.push_back({length, around});
        return unstable;
      },
      resolution);
}

std::vector<UnstableRange> ill_posed(const Model& model) {
  return ranges(model, [](const BaseState& base) { return ill_posed_ripples(base, false); });
}

/// "55.1 to 162.0", with "from rest" and "beyond 200" at the ends of the scan.
std::string to_text(const std::vector<UnstableRange>& found) {
  if (found.empty()) return "stable";
  std::string text;
  for (const UnstableRange& range : found) {
    if (!text.empty()) text += ", ";
    text += range.open_below ? "0" : fmt::format("{:.1f}", range.lower / mmhg);
    text += range.open_above ? " to beyond 200" : fmt::format(" to {:.1f}", range.upper / mmhg);
  }
  return text;
}

struct Growth {
  double rate = 0, frequency = 0, pressure = 0, share = 0;
};

/// The fastest growth at pressures of `step`, 2 `step`, ... up to the greatest one.
Growth fastest_growth(const Model& model, const std::vector<double>& of_shares, double step,
                      double greatest) {
  Growth growth;
  for (int k = 1; k * step <= greatest * (1 + 1e-12); ++k) {
    const BaseState base = base_state(*model, stability::lumen_stretch_at(*model, k * step));
    const Strip strip(base);
    for (const double share : of_shares) {
      const auto mode = strip.least_mode(wave_number(share), density);
      if (mode.growth_rate > growth.rate)
        growth = {mode.growth_rate, std::abs(std::sqrt(-mode.eigenvalue).imag()), base.pressure, share};
    }
  }
  return growth;
}

std::string share_text(double share) {
  return fmt::format("{:.2g} h", share);
}

RippleTable by_law() {
  RippleTable table{
      "laws",
      "Which walls ripple",
      "Lumen pressures in mmHg between which the smooth state is unstable, up to 200 mmHg. *Short waves*: "
      "the limit of\nvanishing wave length, where the problem is ill-posed.",
      {"Law", "Tether", "Short waves", "0.05 h to 100 h", "h to 100 h", "Of these first", "Longest"},
      {}};
  const auto from_h = stability::wave_lengths(h, 100 * h, 81);
  for (const std::string& law : laws)
    for (const char* tether : {"normal", "reference", "current"}) {
      const Model model = wall(law, tether);
      double longest = 0;
      const auto long_waves = ranges(model, [&](const BaseState& base) {
        auto unstable = unstable_ripples(base, {from_h});
        for (const Ripple& ripple : unstable) longest = std::max(longest, ripple.length);
        return unstable;
      });
      table.rows.push_back({law, tether, to_text(ill_posed(model)), to_text(ranges_of(model, all_waves())),
                            to_text(long_waves),
                            long_waves.empty() ? "–" : share_text(long_waves[0].first.length / h),
                            long_waves.empty() ? "–" : share_text(longest / h)});
    }
  return table;
}

RippleTable by_wave_length() {
  RippleTable table{
      "wave_lengths",
      "How short a wave has to be",
      "The printed tether, ripples of one wave length. Growth is that of the wall in empty space. Backward "
      "Euler shows a\nripple that grows as e^(st) only with steps below 2/s, BDF2 below 4/s.",
      {"Law", "Wave length", "Unstable, mmHg", "Fastest growth, 1/s", "at, mmHg", "2/s, s", "4/s, s"},
      {}};
  for (const std::string& law : soft_laws) {
    const Model model = wall(law, "reference");
    for (const double share : shares) {
      const auto found = ranges_of(model, {share * h});
      std::vector<std::string> row{law, share_text(share), to_text(found), "–", "–", "–", "–"};
      if (!found.empty()) {
        const Growth growth = fastest_growth(model, {share}, 2 * mmhg, 170 * mmhg);
        row = {law,
               row[1],
               row[2],
               fmt::format("{:.2g}", growth.rate),
               fmt::format("{:.0f}", growth.pressure / mmhg),
               fmt::format("{:.1g}", 2 / growth.rate),
               fmt::format("{:.1g}", 4 / growth.rate)};
      }
      table.rows.push_back(row);
    }
  }
  return table;
}

/// Those of `lengths` (growing) whose growth rate is above 0 and below a bound, as intervals of shares of h.
std::string waves_growing(const std::vector<double>& lengths, const std::vector<double>& rates,
                          double greatest_rate) {
  std::string text;
  for (std::size_t k = 0; k < lengths.size(); ++k) {
    if (!(rates[k] > 0 && rates[k] < greatest_rate)) continue;
    std::size_t last = k;
    while (last + 1 < lengths.size() && rates[last + 1] > 0 && rates[last + 1] < greatest_rate) ++last;
    if (!text.empty()) text += ", ";
    text += last == k ? fmt::format("near {:.2g} h", lengths[k] / h)
                      : fmt::format("{:.2g} to {:.2g} h", lengths[k] / h, lengths[last] / h);
    k = last;
  }
  return text.empty() ? "none" : text;
}

RippleTable by_step() {
  RippleTable table{
      "steps",
      "What implicit steps show",
      "The printed tether. Of the waves above 0.05 h that grow, those whose growth BDF2 shows at a step "
      "Δt, s < 4/Δt\n(backward Euler: those that BDF2 shows at 2Δt).",
      {"Law", "mmHg", "Grow", "Δt = 10⁻³ s", "Δt = 10⁻⁴ s", "Δt = 10⁻⁵ s"},
      {}};
  const std::vector<std::pair<std::string, std::vector<int>>> states{
      {"EXP2", {10, 40, 70, 90}}, {"EXP1+EXP2-FS", {66, 80, 100, 120, 135}}};
  const auto lengths = stability::wave_lengths(0.05 * h, 10 * h, 93);
  for (const auto& [law, pressures] : states) {
    const Model model = wall(law, "reference");
    for (const int pressure : pressures) {
      const Strip strip(base_state(*model, stability::lumen_stretch_at(*model, pressure * mmhg)));
      std::vector<double> rates;
      for (const double length : lengths)
        rates.push_back(strip.least_mode(2 * std::numbers::pi / length, density).growth_rate);
      std::vector<std::string> row{law, std::to_string(pressure),
                                   waves_growing(lengths, rates, std::numeric_limits<double>::infinity())};
      for (const double step : {1e-3, 1e-4, 1e-5}) row.push_back(waves_growing(lengths, rates, 4 / step));
      table.rows.push_back(row);
    }
  }
  return table;
}

RippleTable by_estimate() {
  RippleTable table{
      "estimate",
      "Twice the shear modulus",
      "The printed tether in the limit of short waves, and where the pressure p of the tether on the "
      "outer surface (per\ncurrent area) exceeds twice the shear modulus μ = ∂P_zr/∂F_zr there; "
      "mmHg.",
      {"Law", "Short waves unstable", "p > 2μ", "p/2μ at the lower end", "p/2μ at the upper end"},
      {}};
  for (const std::string& law : laws) {
    const Model model = wall(law, "reference");
    const auto ratio = [&](double stretch) {
      const auto state = model->respond(stretch, std::array{1.0}, false).states[0];
      const BaseState base = base_state(*model, stretch, {2, 1});
      return model->ring().external_pressure(state.displacement) / (2 * base.outer.tangent[6][6]);
    };
    const auto predicted = ranges(model, [&](const BaseState& base) {
      return ratio(base.lumen_stretch) > 1 ? std::vector<Ripple>{{0}} : std::vector<Ripple>{};
    });
    const auto found = ill_posed(model);
    const auto at = [&](double pressure) {
      return fmt::format("{:.2f}", ratio(stability::lumen_stretch_at(*model, pressure)));
    };
    table.rows.push_back({law, to_text(found), predicted.empty() ? "nowhere" : to_text(predicted),
                          found.empty() || found[0].open_below ? "–" : at(found[0].lower),
                          found.empty() ? "–" : at(found[0].upper)});
  }
  return table;
}

RippleTable by_bulk_modulus() {
  RippleTable table{"bulk_modulus",
                    "Bulk modulus",
                    "The printed tether; the paper's κ is 9·10⁶ dyn/cm². Pressures in mmHg.",
                    {"Law", "κ, dyn/cm²", "Short waves", "Wave length h", "Wave length 3 h"},
                    {}};
  for (const std::string& law : soft_laws)
    for (const char* key : {"wall.bulk_modulus=1e6", "wall.bulk_modulus=3e6", "wall.bulk_modulus=9e6",
                            "wall.bulk_modulus=9e7", "wall.incompressible=true"}) {
      const Model model = wall(law, "reference", {key});
      const std::string value = std::string(key).substr(std::string(key).find('=') + 1);
      table.rows.push_back({law, value == "true" ? "∞" : value, to_text(ill_posed(model)),
                            to_text(ranges_of(model, {h})), to_text(ranges_of(model, {3 * h}))});
    }
  return table;
}

RippleTable by_elements() {
  RippleTable table{
      "elements",
      "What coarse elements see",
      "The same with elements of degree 1 and 2 through the wall, cells halving towards both surfaces; "
      "exact along the\naxis. Without a pressure of their own they lock. mmHg.",
      {"Law", "Degree", "Cells", "0.25 h", "1 h", "3 h", "5 h"},
      {}};
  for (const std::string& law : soft_laws) {
    const Model model = wall(law, "reference");
    struct Mesh {
      int degree;
      double shortest;
      int cells;
    };
    for (const Mesh mesh : {Mesh{1, 0.5, 2},
                            {1, 0.25, 4},
                            {1, 0.0625, 8},
                            {1, 0.016, 12},
                            {2, 0.5, 2},
                            {2, 0.25, 4},
                            {2, 0.0625, 8},
                            {8, 0.05, 10}}) {
      std::vector<std::string> row{law, std::to_string(mesh.degree), std::to_string(mesh.cells)};
      for (const double share : {0.25, 1.0, 3.0, 5.0})
        row.push_back(to_text(ranges_of(model, {share * h}, 0, {mesh.degree, mesh.shortest})));
      table.rows.push_back(row);
    }
  }
  return table;
}

RippleTable by_direction() {
  RippleTable table{
      "directions",
      "Ripples in three dimensions",
      "The printed tether. Short ripples that run at an angle to the axis (0°: along it, 90°: around the "
      "ring), and waves of\nlength h along the axis with m waves around. mmHg.",
      {"Law", "0°", "30°", "60°", "90°", "h, m = 0", "h, m = 3", "h, m = 10"},
      {}};
  for (const std::string& law : soft_laws) {
    const Model model = wall(law, "reference");
    std::vector<std::string> row{law};
    for (const double degrees : {0.0, 30.0, 60.0, 90.0})
      row.push_back(to_text(ranges(model, [&](const BaseState& base) {
        const double angle = degrees * std::numbers::pi / 180;
        return HalfSpace(base.outer).least_stiffness(angle) < 0 ? std::vector<Ripple>{{0}}
                                                                : std::vector<Ripple>{};
      })));
    for (const int around : {0, 3, 10}) row.push_back(to_text(ranges_of(model, {h}, around)));
    table.rows.push_back(row);
  }
  return table;
}

RippleTable of_current() {
  RippleTable table{
      "current",
      "The tether per current area",
      "Its load has no energy. *Energy*: mmHg where the symmetric part of K is not positive, 0.05 h to 100 "
      "h, which a conservative\nload would make an instability. *Monotone growth*: where K itself has an "
      "eigenvalue below 0. *Flutter*: fastest growth of an\noscillation where two modes meet, undamped, up "
      "to 160 mmHg.",
      {"Law", "Energy", "Monotone growth", "Flutter, 1/s", "at angular frequency, 1/s", "at, mmHg",
       "Wave length"},
      {}};
  const std::vector<double> flutter_shares{0.05, 0.1, 0.2, 0.5, 1, 2, 4, 7, 10, 14, 20, 30, 50, 100};
  for (const std::string& law : laws) {
    const Model model = wall(law, "current");
    const auto energy = ranges(model, [&](const BaseState& base) {
      const Strip strip(base);
      std::vector<Ripple> unstable;
      for (const double length : all_waves()) {
        const Eigen::MatrixXd k = strip.surface_stiffness(2 * std::numbers::pi / length);
        const Eigen::MatrixXd symmetric = 0.5 * (k + k.transpose());
        if (k.size() == 0 || Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric).eigenvalues()[0] < 0)
          unstable.push_back({length});
      }
      return unstable;
    });
    const Growth growth = fastest_growth(model, flutter_shares, 20 * mmhg, 160 * mmhg);
    table.rows.push_back({law, energy.empty() ? "positive" : to_text(energy),
                          to_text(ranges_of(model, all_waves())),
                          growth.rate > 0 ? fmt::format("{:.2g}", growth.rate) : "none",
                          growth.rate > 0 ? fmt::format("{:.1g}", growth.frequency) : "–",
                          growth.rate > 0 ? fmt::format("{:.0f}", growth.pressure / mmhg) : "–",
                          growth.rate > 0 ? share_text(growth.share) : "–"});
  }
  return table;
}

RippleTable of_convergence() {
  RippleTable table{"convergence",
                    "Convergence",
                    "Least eigenvalue λ = −s² in 1/s² with the printed tether at 100 mmHg, and its relative "
                    "difference from degree 14 (10 or 11\ncells through the wall).",
                    {"Law", "Wave length", "λ", "degree 4", "degree 6", "degree 8 (used)", "degree 10"},
                    {}};
  for (const std::string& law : soft_laws) {
    const Model model = wall(law, "reference");
    const double stretch = stability::lumen_stretch_at(*model, 100 * mmhg);
    for (const double share : {0.05, 1.0, 5.0, 50.0}) {
      const auto least = [&](int degree) {
        return Strip(base_state(*model, stretch, {degree, 0.05}))
            .least_mode(wave_number(share), density)
            .eigenvalue.real();
      };
      const double exact = least(14);
      std::vector<std::string> row{law, share_text(share), fmt::format("{:.4g}", exact)};
      for (const int degree : {4, 6, 8, 10}) {
        const double gap = std::abs(least(degree) / exact - 1);
        row.push_back(gap < 1e-6 ? "below 1e-06" : fmt::format("{:.0e}", gap));
      }
      table.rows.push_back(row);
    }
  }
  return table;
}

}  // namespace

std::vector<RippleTable> ripple_tables() {
  return {by_law(),      by_wave_length(), by_step(),    by_estimate(),   by_bulk_modulus(),
          by_elements(), by_direction(),   of_current(), of_convergence()};
}

RippleTable growth_map() {
  RippleTable table{"growth", "", "", {"law", "pressure[mmHg]", "wave_length[cm]", "growth_rate[1/s]"}, {}};
  for (const std::string& law : soft_laws) {
    const Model model = wall(law, "reference");
    for (int pressure = 2; pressure <= 170; pressure += 2) {
      const Strip strip(base_state(*model, stability::lumen_stretch_at(*model, pressure * mmhg)));
      for (const double length : stability::wave_lengths(0.05 * h, 12 * h, 40))
        table.rows.push_back(
            {law, std::to_string(pressure), fmt::format("{:.5g}", length),
             fmt::format("{:.5g}", strip.least_mode(2 * std::numbers::pi / length, density).growth_rate)});
    }
  }
  return table;
}

}  // namespace tunica::verification
