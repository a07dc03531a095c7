// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/stability/warning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "core/error.hpp"
#include "core/radial/compressible_ring.hpp"
#include "core/radial/from_scene.hpp"
#include "core/radial/incompressible_ring.hpp"
#include "core/stability/half_space.hpp"
#include "core/stability/scan.hpp"
#include "core/units.hpp"

namespace tunica::stability {

namespace {

/// The shortest ripple that is looked at, beside the limit of short waves; a share of the thickness.
constexpr double shortest = 0.1;

struct Findings {
  std::vector<UnstableRange> ranges;
  double longest = 0;  ///< of the ripples that grow, cm
  struct Worst {
    double pressure, stiffness;
    HalfSpace surface;
  };
  std::optional<Worst> worst;  ///< where a surface yields most to short waves, if one does
};

Findings look(const radial::RingModel& model, double greatest_pressure) {
  const double thickness = model.ring().thickness;
  const Ripples ripples{wave_lengths(shortest * thickness, 30 * thickness, 12)};
  Findings findings;
  const auto search = [&](const BaseState& base) {
    auto unstable = unstable_ripples(base, ripples);
    for (const Ripple& ripple : unstable) findings.longest = std::max(findings.longest, ripple.length);
    for (const SurfaceState* side : {&base.inner, &base.outer}) {
      const HalfSpace surface(*side);
      const double stiffness = surface.least_stiffness(0);
      if (stiffness >= 0) continue;
      unstable.push_back({0});
      if (!findings.worst || stiffness < findings.worst->stiffness)
        findings.worst = {base.pressure, stiffness, surface};
    }
    return unstable;
  };
  const Scan scan{.lower = 0.01 * greatest_pressure,
                  .upper = greatest_pressure,
                  .steps = 16,
                  .tolerance = 3e-3,
                  .resolution = {.degree = 6, .shortest_wave = shortest}};
  findings.ranges = unstable_ranges(model, scan, search);
  return findings;
}

bool is_stable_with_normal_tether(radial::Ring<double> ring, double greatest_pressure) {
  ring.traction = radial::TetherTraction::normal;
  const auto stable = [&](const radial::RingModel& model) {
    return look(model, greatest_pressure).ranges.empty();
  };
  if (ring.incompressible) return stable(radial::IncompressibleRing(std::move(ring), {}));
  return stable(radial::CompressibleRing(std::move(ring), {}));
}

std::string describe(const Findings& findings, double thickness, double density, double greatest_pressure) {
  std::string pressures;
  for (const UnstableRange& range : findings.ranges)
    pressures += fmt::format("{}{:.0f} to {:.0f} mmHg", pressures.empty() ? "" : " and ", range.lower / mmhg,
                             range.upper / mmhg);
  std::string message = fmt::format(
      "the smooth wall is linearly unstable to ripples along the vessel at lumen pressures from {} (looked "
      "at "
      "up to {:.0f} mmHg)",
      pressures, greatest_pressure / mmhg);
  if (findings.longest > 0) message += fmt::format(", of wave lengths up to {:.2g} cm", findings.longest);
  if (findings.worst) {
    const double length = shortest * thickness;
    const double rate = 2 * std::numbers::pi / length * findings.worst->surface.growth_speed(0, density);
    message += fmt::format(
        "; the shorter the faster: one of {:.2g} cm grows e-fold in {:.1g} s at {:.0f} mmHg, so that "
        "refining "
        "the mesh makes it worse",
        length, 1 / rate, findings.worst->pressure / mmhg);
  }
  return message;
}

}  // namespace

bool may_ripple(const Scene& scene) {
  return scene.text("tether.traction") != "normal" || scene.number("tether.stiffness") == 0;
}

std::optional<std::string> warning(const Scene& scene, double greatest_pressure) {
  if (!(greatest_pressure > 0)) return {};
  const auto model = radial::ring_model(scene, {});
  try {
    const Findings findings = look(*model, greatest_pressure);
    if (findings.ranges.empty()) return {};
    const std::string& traction = scene.text("tether.traction");
    const std::string message = fmt::format(
        "tether.traction = \"{}\": {}", traction,
        describe(findings, model->ring().thickness, scene.number("wall.density"), greatest_pressure));
    if (traction != "normal" && is_stable_with_normal_tether(model->ring(), greatest_pressure))
      return message + "; use tether.traction = \"normal\", with which it is stable";
    return message + "; use a stiffer wall or tether, or lower pressures";
  } catch (const SolverFailure&) {
    return {};
  }
}

}  // namespace tunica::stability
