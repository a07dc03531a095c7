// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/inlet.hpp"
#include "core/radial/ring.hpp"
#include "core/scene/scene.hpp"

namespace tunica::coupled {

/// Energy (squares of amplitudes) of a signal's harmonics about a frequency.
struct Band {
  double frequency;  ///< 1/s, the highest of the band
  double energy;
};

/// How the inlet's changes are spread over frequencies: its harmonics but for the mean and, of a start from
/// rest, its growth as a wave whose period is the ramp (of infinite frequency where there is none).
std::vector<Band> spectrum(const Inlet& inlet, bool from_rest);

/// Speed of long waves about a lumen pressure, of a lumen of area A (Bramwell-Hill, which is Moens-Korteweg's
/// for a thin elastic wall): c^2 = A/rho dp/dA = s/(2 rho) dp/ds for the lumen stretch s. The pressure is met
/// to a twentieth of stretch, from the slower side. Throws SolverFailure where the wall does not get there.
double wave_speed(const radial::RingModel& ring, double pressure, double blood_density);

/// Cells that a wave length takes for an error of a size; errors fall with an order of their length.
struct WaveCells {
  double count, error, order;
};

/// The longest cell, in wave lengths of the speed per second (cm for a speed in cm/s), with which the root
/// mean square error of waves of this spectrum is `tolerance` of the root mean square of all.
double longest_cell(const std::vector<Band>& spectrum, double speed, const WaveCells& cells,
                    double tolerance);

}  // namespace tunica::coupled
