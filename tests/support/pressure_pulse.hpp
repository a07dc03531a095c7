// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "core/scene/scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tunica::test_support {

/// A pulse of pressure height (1 - cos(2 pi t/duration))/2 at the inlet of the paper's artery with a stiff
/// wall (St. Venant-Kirchhoff, 3e6 dyn/cm2), once a period, as a table of a hundred points in the pulse.
class PressurePulse {
 public:
  static constexpr double height = 1.3332e4;  // dyn/cm2

  PressurePulse(double duration, double period) : period_(period) {
    std::ofstream file(folder_.path() / "pulse.csv");
    file << "time[s],pressure[dyn/cm2]\n";
    const long steps = std::lround(100 * period / duration);
    for (long k = 0; k <= steps; ++k) {
      const double time = period * static_cast<double>(k) / static_cast<double>(steps);
      const double pressure =
          time < duration ? 0.5 * height * (1 - std::cos(2 * std::numbers::pi * time / duration)) : 0;
      file << fmt::format("{:.12g},{:.12g}\n", time, pressure);
    }
  }

  Scene scene(const std::vector<std::string>& overrides) const {
    const std::string text = fmt::format(
        "[wall]\nlaw = \"St-Venant-Kirchhoff\"\nyoung_modulus = 3e6\npoisson_ratio = 0.3\n"
        "[inlet]\nwaveform = \"pulse.csv\"\n[outlet]\nresistance = 1e5\n"
        "[time]\nbeats = 1\nramp = 0\n[output]\ninterval = {}\nfield_interval = 0\n",
        period_ / 200);
    return parse_scene(text, "pulse", folder_.path(), overrides);
  }

 private:
  TemporaryFolder folder_;
  double period_;
};

}  // namespace tunica::test_support
