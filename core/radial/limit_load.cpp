// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/radial/limit_load.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/root.hpp"

namespace tunica::radial {

std::optional<LimitLoad> limit_load(const RingModel& ring, double greatest_stretch) {
  constexpr double growth = 1.02;
  struct Place {
    double stretch, pressure, slope;
  };
  const auto at = [&](double stretch) {
    const RingResponse response = ring.respond(stretch, {}, false);
    return Place{stretch, response.pressure, response.pressure_slope};
  };
  std::optional<LimitLoad> limit;
  try {
    Place here = at(1.0);
    while (here.stretch < greatest_stretch) {
      const Place next = at(std::min(greatest_stretch, growth * here.stretch));
      if (here.slope > 0 && next.slope < 0) {
        const double top = find_root([&](double s) { return at(s).slope; }, here.stretch, next.stretch, 1e-6);
        const double pressure = at(top).pressure;
        if (!limit || pressure > limit->pressure) limit = {pressure, top};
      }
      here = next;
      if (limit && here.pressure > limit->pressure) limit.reset();
    }
    constexpr double far = 3, hardly = 1.1;
    if (!limit && here.pressure > 0 && at(far * greatest_stretch).pressure < hardly * here.pressure)
      limit = {here.pressure, here.stretch};
  } catch (const SolverFailure&) {
    return std::nullopt;
  }
  return limit;
}

}  // namespace tunica::radial
