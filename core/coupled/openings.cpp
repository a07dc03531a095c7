// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/coupled/openings.hpp"

namespace tunica::coupled {

std::optional<std::size_t> pressure_entry(const Layout& layout, Boundary boundary) {
  if (boundary == Boundary::inlet) return layout.inlet_pressure;
  if (boundary == Boundary::outlet) return layout.outlet_pressure;
  return std::nullopt;
}

std::vector<ScalarRow> scalar_rows(const Layout& layout, const OutletCondition& outlet, double copies,
                                   Boundary boundary) {
  if (boundary == Boundary::inlet && layout.inlet_pressure) return {{*layout.inlet_pressure, -copies}};
  if (boundary != Boundary::outlet || !layout.outlet_pressure) return {};
  if (!layout.windkessel_pressure) return {{*layout.outlet_pressure, -copies * outlet.resistance}};
  return {{*layout.outlet_pressure, -copies * outlet.proximal_resistance},
          {*layout.windkessel_pressure, -copies}};
}

void add_scalars(const InletCondition& inlet, const OutletCondition& outlet, const Layout& layout,
                 const Stage& stage, std::span<const double> y, std::span<double> residual) {
  if (layout.inlet_pressure) residual[layout.unknown(*layout.inlet_pressure)] -= inlet.value(stage.time);
  if (!layout.outlet_pressure) return;
  double& row = residual[layout.unknown(*layout.outlet_pressure)];
  row += y[*layout.outlet_pressure];
  const double beyond = outlet.pressure(stage.time);
  if (!layout.windkessel_pressure) {
    row -= beyond;
    return;
  }
  const std::size_t stored = *layout.windkessel_pressure;
  row -= y[stored];
  residual[layout.unknown(stored)] +=
      outlet.compliance * rate(stage, y, stored) + (y[stored] - beyond) / outlet.resistance;
}

void add_scalar_change(const OutletCondition& outlet, const Layout& layout, const Stage& along,
                       std::span<const double> y, std::span<double> change) {
  if (!layout.outlet_pressure) return;
  double& row = change[layout.unknown(*layout.outlet_pressure)];
  row += y[*layout.outlet_pressure];
  if (!layout.windkessel_pressure) return;
  const std::size_t stored = *layout.windkessel_pressure;
  row -= y[stored];
  change[layout.unknown(stored)] +=
      outlet.compliance * rate(along, y, stored) + y[stored] / outlet.resistance;
}

std::vector<ScalarEntry> scalar_tangent(const OutletCondition& outlet, const Layout& layout,
                                        double coefficient) {
  if (!layout.outlet_pressure) return {};
  const int at_outlet = layout.unknown(*layout.outlet_pressure);
  std::vector<ScalarEntry> entries{{at_outlet, at_outlet, 1.0}};
  if (!layout.windkessel_pressure) return entries;
  const int stored = layout.unknown(*layout.windkessel_pressure);
  entries.push_back({at_outlet, stored, -1.0});
  entries.push_back({stored, stored, outlet.compliance * coefficient + 1 / outlet.resistance});
  return entries;
}

}  // namespace tunica::coupled
