// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/limit_cycle.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace tunica::axisym {

namespace {

/// Sizes that make the fields of a state comparable.
std::vector<double> field_weights(const Layout& layout, const std::vector<double>& state) {
  double sizes[3] = {0, 0, 0};
  const auto field = [&](std::size_t e) {
    return e < layout.velocity_begin() ? 0 : e < layout.pressure_begin() ? 1 : 2;
  };
  for (std::size_t e = 0; e < state.size(); ++e)
    sizes[field(e)] = std::max(sizes[field(e)], std::abs(state[e]));
  std::vector<double> weights(state.size());
  for (std::size_t e = 0; e < state.size(); ++e) weights[e] = sizes[field(e)] > 0 ? 1 / sizes[field(e)] : 0.0;
  return weights;
}

}  // namespace

LimitCycle limit_cycle(Simulation& simulation, std::vector<double> guess, double period, double tolerance,
                       const std::function<bool()>& interrupted, LimitCycleReport& report, int most) {
  constexpr std::size_t depth = 5;
  using Vector = Eigen::VectorXd;
  const auto size = static_cast<Eigen::Index>(guess.size());
  Vector x = Eigen::Map<const Vector>(guess.data(), size);
  std::vector<Vector> images, differences;
  std::vector<double> rates;
  for (;;) {
    simulation.start(0, std::vector<double>(x.data(), x.data() + size), rates);
    while (simulation.time() < period) {
      if (interrupted()) return {};
      simulation.advance(period);
    }
    rates = simulation.rates();
    const Vector image = Eigen::Map<const Vector>(simulation.state().data(), size);
    const auto weights = field_weights(simulation.layout(), simulation.state());
    const Vector w = Eigen::Map<const Vector>(weights.data(), size);
    const Vector difference = image - x;
    ++report.periods;
    // Pressures follow from the rest, and are disturbed for a few steps by rates that are not quite theirs.
    const auto pressures = static_cast<Eigen::Index>(simulation.layout().pressure_begin());
    report.change = difference.head(pressures).cwiseProduct(w.head(pressures)).lpNorm<Eigen::Infinity>();
    if (report.change <= 0.1 * tolerance) return {simulation.state(), std::move(rates)};
    if (report.periods >= most)
      throw SolverFailure(fmt::format(
          "no limit cycle within {} periods: the state still changes by {:.2g} of its size per period",
          report.periods, report.change));
    images.push_back(image);
    differences.push_back(difference);
    if (images.size() > depth) {
      images.erase(images.begin());
      differences.erase(differences.begin());
    }
    const auto m = static_cast<Eigen::Index>(images.size());
    x = image;
    if (m == 1) continue;
    Eigen::MatrixXd changes(size, m - 1);
    for (Eigen::Index k = 0; k + 1 < m; ++k)
      changes.col(k) = w.cwiseProduct(differences[k + 1] - differences[k]);
    const Vector mix = changes.colPivHouseholderQr().solve(w.cwiseProduct(difference));
    for (Eigen::Index k = 0; k + 1 < m; ++k) x -= mix[k] * (images[k + 1] - images[k]);
  }
}

}  // namespace tunica::axisym
