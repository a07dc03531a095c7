// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/radial/ring.hpp"

/// Rings that stand in for another on the way to its equilibrium.
namespace tunica::radial {

/// True when the stress of a family is not 0 at its threshold.
bool stress_jumps(const Ring<double>& ring);

/// Families at +beta and -beta act alike on a ring, whose shear stress nobody asks for: one of twice
/// the weight stands for both.
Ring<double> with_mirror_images_merged(Ring<double> ring);

Ring<double> with_sharpness_at_most(Ring<double> ring, double sharpness);

/// With bulk moduli a factor larger; none for laws that do not split the volume change off.
std::optional<Ring<double>> with_bulk_moduli_times(Ring<double> ring, double factor);

}  // namespace tunica::radial
