// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/stability/scan.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/stability/half_space.hpp"

namespace tunica::stability {

std::vector<double> wave_lengths(double shortest, double longest, int count) {
  std::vector<double> lengths(count);
  for (int k = 0; k < count; ++k) lengths[k] = shortest * std::pow(longest / shortest, k / (count - 1.0));
  return lengths;
}

std::vector<Ripple> unstable_ripples(const BaseState& base, const Ripples& ripples) {
  std::vector<Ripple> unstable;
  for (int m = 0; m <= ripples.most_around; ++m) {
    const Strip strip(base, m, ripples.twist);
    for (const double length : ripples.lengths)
      if (!strip.is_stable(2 * std::numbers::pi / length)) unstable.push_back({length, m});
  }
  return unstable;
}

std::vector<Ripple> ill_posed_ripples(const BaseState& base, bool oblique) {
  constexpr int directions = 12;  // of half a turn; the stiffness is smooth in the angle
  for (const SurfaceState* surface : {&base.outer, &base.inner})
    for (int k = 0; k < (oblique ? directions : 1); ++k)
      if (HalfSpace(*surface).least_stiffness(std::numbers::pi * k / directions) < 0) return {{0, 0}};
  return {};
}

std::vector<UnstableRange> unstable_ranges(
    const radial::RingModel& model, const Scan& scan,
    const std::function<std::vector<Ripple>(const BaseState&)>& search) {
  struct State {
    double stretch, pressure;
    std::vector<Ripple> ripples;
  };
  const auto state_at = [&](double stretch) {
    const BaseState base = base_state(model, stretch, scan.resolution);
    return State{stretch, base.pressure, search(base)};
  };
  const auto longest = [](const State& state) {
    return *std::max_element(state.ripples.begin(), state.ripples.end(),
                             [](const Ripple& a, const Ripple& b) { return a.length < b.length; });
  };
  /// The last unstable state between one that is and one that is not.
  const auto edge = [&](State unstable, State stable) {
    while (std::abs(unstable.stretch - stable.stretch) > scan.tolerance) {
      State middle = state_at(0.5 * (unstable.stretch + stable.stretch));
      (middle.ripples.empty() ? stable : unstable) = std::move(middle);
    }
    return unstable;
  };

  std::vector<UnstableRange> ranges;
  const auto begin = [&](const State& state, bool open) {
    ranges.push_back({state.pressure, state.pressure, open, true, longest(state), longest(state)});
  };
  const auto go_on = [&](const State& state, bool open) {
    UnstableRange& range = ranges.back();
    range.lower = std::min(range.lower, state.pressure);
    range.upper = std::max(range.upper, state.pressure);
    range.open_above = open;
    range.last = longest(state);
  };
  const double from = lumen_stretch_at(model, scan.lower), to = lumen_stretch_at(model, scan.upper);
  State before = state_at(from);
  if (!before.ripples.empty()) begin(before, true);
  for (int k = 1; k <= scan.steps; ++k) {
    State here = state_at(from + (to - from) * k / scan.steps);
    if (before.ripples.empty() && !here.ripples.empty()) begin(edge(here, before), false);
    if (!here.ripples.empty()) go_on(here, true);
    if (!before.ripples.empty() && here.ripples.empty()) go_on(edge(before, here), false);
    before = std::move(here);
  }
  return ranges;
}

}  // namespace tunica::stability
