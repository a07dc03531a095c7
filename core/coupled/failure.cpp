// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/coupled/failure.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/radial/limit_load.hpp"
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
  const auto limit = radial::limit_load(*ring, radial::WallCurve::greatest_stretch);
  if (!limit || limit->pressure >= pressure) return {};
  return fmt::format(
      "; the wall cannot carry {:.4g} mmHg: as a ring it carries at most {:.4g} mmHg, at lumen "
      "stretch {:.3g}",
      pressure / mmhg, limit->pressure / mmhg, limit->stretch);
}

}  // namespace tunica::coupled
