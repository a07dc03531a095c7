// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/coupled/limit_cycle.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/linear/anderson.hpp"

namespace tunica::coupled {

namespace {

/// Least and greatest value of every entry in a period.
class Range {
 public:
  explicit Range(const std::vector<double>& state) : least_(state), greatest_(state) {}

  void include(const std::vector<double>& state) {
    for (std::size_t e = 0; e < state.size(); ++e) {
      least_[e] = std::min(least_[e], state[e]);
      greatest_[e] = std::max(greatest_[e], state[e]);
    }
  }

  /// Weights of what a vessel remembers from period to period: displacement of the wall (of a rigid pipe,
  /// velocity of the blood) and charge of the outlet's compliance. All else follows within a period. They
  /// are reciprocals of the greatest range in a period, of that field and of the pressure at the outlet, or
  /// of a thousandth of the size, or of that to be expected, of what hardly changes.
  Eigen::VectorXd weights(const Equations& equations, const Newton::Sizes& expected) const {
    const Layout& layout = equations.layout();
    const bool moves = equations.has_wall();
    std::vector<std::size_t> field;
    for (int u = 0; u < layout.unknowns(); ++u) {
      const std::size_t e = layout.entry(u);
      const bool is_wall = e < layout.velocity_begin() && layout.on_wall(layout.node_of(e));
      const bool is_velocity = e >= layout.velocity_begin() && e < layout.pressure_begin();
      if (moves ? is_wall : is_velocity) field.push_back(e);
    }
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(least_.size()));
    const double of_field = reciprocal(field, moves ? expected.displacement : expected.velocity);
    for (const std::size_t e : field) weights[static_cast<Eigen::Index>(e)] = of_field;
    if (layout.windkessel_pressure)
      weights[static_cast<Eigen::Index>(*layout.windkessel_pressure)] =
          reciprocal({*layout.outlet_pressure}, expected.pressure);
    return weights;
  }

 private:
  double reciprocal(const std::vector<std::size_t>& entries, double expected) const {
    constexpr double hardly = 1e-3;
    double range = hardly * expected;
    for (const std::size_t e : entries)
      range = std::max(
          {range, greatest_[e] - least_[e], hardly * std::abs(least_[e]), hardly * std::abs(greatest_[e])});
    return range > 0 ? 1 / range : 0;
  }

  std::vector<double> least_, greatest_;
};

}  // namespace

namespace {

/// Mean square over the entries of the field, as steps are judged by, so that single nodes do not hold the
/// search up by what steps leave in them; the charge of the outlet counts by itself.
double norm_of(const Eigen::VectorXd& weighed, std::optional<std::size_t> charge) {
  const double of_charge = charge ? std::abs(weighed[static_cast<Eigen::Index>(*charge)]) : 0;
  const auto entries = static_cast<double>((weighed.array() != 0).count());
  if (entries == 0) return 0;
  return std::max(of_charge, std::sqrt((weighed.squaredNorm() - of_charge * of_charge) / entries));
}

}  // namespace

LimitCycle limit_cycle(Simulation& simulation, std::vector<double> guess, double period, double tolerance,
                       const std::function<bool()>& interrupted, LimitCycleReport& report, int most) {
  constexpr std::size_t depth = 3;
  using Vector = Eigen::VectorXd;
  const auto size = static_cast<Eigen::Index>(guess.size());
  Vector x = Eigen::Map<const Vector>(guess.data(), size);
  linear::Anderson anderson(depth);
  std::vector<double> rates;
  for (;;) {
    simulation.start(0, std::vector<double>(x.data(), x.data() + size), rates);
    Range range(simulation.state());
    while (simulation.time() < period) {
      if (interrupted()) return {};
      simulation.advance(period);
      range.include(simulation.state());
    }
    rates = simulation.rates();
    const Vector image = Eigen::Map<const Vector>(simulation.state().data(), size);
    const Vector weights = range.weights(simulation.equations(), simulation.expected_sizes());
    ++report.periods;
    const Vector difference = image - x;
    x = anderson.next(x, image, weights);
    const auto norm = [&](const Vector& v) {
      return norm_of(v.cwiseProduct(weights), simulation.layout().windkessel_pressure);
    };
    // What changes slowly may still be far from its end. The extrapolation knows how far, but from two
    // periods alone it cannot tell that from what dies at once. It magnifies what steps leave in a period as
    // it does the change, so that less than a few tenths of the tolerance cannot be asked of it.
    const double change = norm(difference);
    const double left = anderson.images() > 2 ? norm(x - image) : 10 * change;
    report.change = std::max(change, left);
    if (change <= 0.1 * tolerance && left <= 0.3 * tolerance) return {simulation.state(), std::move(rates)};
    if (report.periods >= most)
      throw SolverFailure(
          fmt::format("no limit cycle within {} periods: the state is still {:.2g} of its range away from it",
                      report.periods, report.change));
  }
}

}  // namespace tunica::coupled
