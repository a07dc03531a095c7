// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/coupled/failure.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/radial/wall_curve.hpp"
#include "core/units.hpp"

namespace tunica::coupled {

namespace {

/// Cells that are compressed to less than this are taken for the cause.
constexpr double compressed = 0.15;

}  // namespace

std::string place_of(const Equations& equations, std::size_t entry) {
  const Layout& layout = equations.layout();
  if (entry >= layout.scalar_begin())
    return entry == layout.inlet_pressure ? "pressure at the inlet" : "pressure at the outlet";
  const int node = layout.node_of(entry);
  const char* field = "blood's pressure";
  if (entry < layout.velocity_begin())
    field = layout.on_wall(node) ? "wall's displacement" : "motion of the mesh";
  else if (entry < layout.pressure_begin())
    field = "blood's velocity";
  return fmt::format("{} at {}", field, equations.place_of_node(node));
}

std::string explain(const Equations& equations, const NewtonReport& report) {
  const LeastJacobian& least = equations.least_jacobian();
  std::string text = report.failure;
  if (least.cell >= 0 && !(least.value >= compressed)) return text + equations.compression(least);
  return report.worst ? text + "; farthest from a solution is the " + place_of(equations, *report.worst)
                      : text;
}

std::string limit_of_wall(const radial::RingModel* ring, double pressure) {
  if (!ring || pressure <= 0) return {};
  constexpr double growth = 1.03;
  // Where pressure grows by less than this share of the growth of the stretch, it will not grow much more.
  constexpr double flat = 0.3;
  double greatest = 0, at = 1, before = 0;
  bool is_flat = false;
  try {
    for (double stretch = growth; stretch < radial::WallCurve::greatest_stretch; stretch *= growth) {
      const double p = ring->respond(stretch, {}, false).pressure;
      if (p >= pressure) return {};
      is_flat = p < before * (1 + flat * (growth - 1));
      before = p;
      if (p > greatest) {
        greatest = p;
        at = stretch;
      }
    }
  } catch (const SolverFailure&) {
    // What was found up to there counts.
  }
  if (!is_flat) return {};
  return fmt::format(
      "; the wall cannot carry {:.4g} mmHg: as a ring it carries at most {:.4g} mmHg, at lumen "
      "stretch {:.3g}",
      pressure / mmhg, greatest / mmhg, at);
}

}  // namespace tunica::coupled
