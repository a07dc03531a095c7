// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/coupled/waves.hpp"

#include <gsl/gsl_fft_real.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/gsl.hpp"
#include "core/radial/wall_curve.hpp"

namespace tunica::coupled {

std::vector<Band> spectrum(const Inlet& inlet, bool from_rest) {
  // A power of two, and steps of 50 microseconds in a beat of 0.8 s.
  constexpr std::size_t samples = 1 << 14;
  constexpr double widest = 1.05;
  std::vector<double> values(samples);
  for (std::size_t k = 0; k < samples; ++k)
    values[k] = inlet.shape->at(inlet.period * static_cast<double>(k) / samples);
  check_gsl(gsl_fft_real_radix2_transform(values.data(), 1, samples), "gsl_fft_real_radix2_transform");
  // Real parts of the harmonics, then, backwards, their imaginary parts.
  std::vector<Band> bands;
  double first = 0;
  for (std::size_t k = 1; k < samples / 2; ++k) {
    const double frequency = static_cast<double>(k) / inlet.period;
    const double energy = 4 * (std::pow(values[k], 2) + std::pow(values[samples - k], 2)) / samples / samples;
    if (bands.empty() || frequency > widest * first) {
      first = frequency;
      bands.push_back({frequency, 0});
    }
    bands.back().frequency = frequency;
    bands.back().energy += energy;
  }
  if (!from_rest) return bands;
  const double reached = inlet.shape->at(inlet.ramp);
  constexpr double at_once = std::numeric_limits<double>::infinity();
  bands.push_back({inlet.ramp > 0 ? 1 / inlet.ramp : at_once, reached * reached});
  return bands;
}

double wave_speed(const radial::RingModel& ring, double pressure, double blood_density) {
  constexpr double step = 0.05;
  double slowest = std::numeric_limits<double>::infinity();
  for (double stretch = 1; stretch <= radial::WallCurve::greatest_stretch; stretch += step) {
    const auto response = ring.respond(stretch, {}, false);
    const double squared = 0.5 * stretch * response.pressure_slope / blood_density;
    const double speed = squared > 0 ? std::sqrt(squared) : 0;
    if (response.pressure >= pressure) return std::min(slowest, speed);
    // Of the two states about the pressure.
    slowest = speed;
  }
  throw SolverFailure("the wall does not bear the pressure whose waves are asked for");
}

double longest_cell(const std::vector<Band>& spectrum, double speed, const WaveCells& cells,
                    double tolerance) {
  double total = 0;
  for (const Band& band : spectrum) total += band.energy;
  if (!(total > 0)) return std::numeric_limits<double>::infinity();
  const auto error = [&](double length) {
    double squared = 0;
    for (const auto& [frequency, energy] : spectrum) {
      // A wave that the cells do not follow is lost as a whole.
      const double share = cells.error * std::pow(cells.count * length * frequency / speed, cells.order);
      squared += energy * std::pow(std::min(1.0, share), 2);
    }
    return std::sqrt(squared / total);
  };
  // From cells so short that they follow all to a wave length of a second.
  double shortest = 0, longest = speed;
  if (error(longest) <= tolerance) return std::numeric_limits<double>::infinity();
  constexpr int halvings = 40;
  for (int k = 0; k < halvings; ++k) {
    const double middle = 0.5 * (shortest + longest);
    (error(middle) <= tolerance ? shortest : longest) = middle;
  }
  return shortest;
}

}  // namespace tunica::coupled
