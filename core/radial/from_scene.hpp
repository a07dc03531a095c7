// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/radial/ring.hpp"
#include "core/scene/seeded.hpp"

namespace tunica::radial {

/// The ring of a scene's wall and tether. Instantiated for double and Dual<double, 1>.
template <class P>
Ring<P> ring_from_scene(const SeededScene<P>& scene);

/// The ring as a model that can be asked for its equilibrium, with derivatives with respect to the
/// parameters named, its responses to so relative an accuracy (1e-10 at best) or better. Throws InvalidInput
/// for a wall that has no classical equilibrium.
std::unique_ptr<const RingModel> ring_model(const Scene& scene, const std::vector<std::string>& parameters,
                                            double accuracy = 1e-10);

}  // namespace tunica::radial
