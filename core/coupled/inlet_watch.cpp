// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/coupled/inlet_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tunica::coupled {

void InletWatch::look(double time, const Throughflow& inlet) {
  greatest_ = std::max(greatest_, std::abs(inlet.net));
  if (inlet.net >= 0 || inlet.leaving <= leaving_) return;
  time_ = time;
  leaving_ = inlet.leaving;
  entering_ = inlet.leaving - inlet.net;
}

std::string InletWatch::finding() const {
  if (leaving_ <= std::max(still_, tolerated * greatest_)) return {};
  return fmt::format(
      "blood turns back on the inlet: at t = {:.4g} s {:.3g} cm3/s leave through a part of it while {:.3g} "
      "cm3/s come in, and what is computed downstream rests on a profile that nothing decides; prescribe a "
      "flow with inlet.profile = \"parabolic\"{}",
      time_, leaving_, entering_, is_total_ ? "" : ", or drive it with inlet.pressure_kind = \"total\"");
}

void InletWatch::restore(const std::vector<double>& saved) {
  greatest_ = saved.at(0);
  time_ = saved.at(1);
  leaving_ = saved.at(2);
  entering_ = saved.at(3);
}

}  // namespace tunica::coupled
