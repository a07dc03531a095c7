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
/// parameters named. Throws InvalidInput for a wall that has no classical equilibrium.
std::unique_ptr<const RingModel> ring_model(const Scene& scene, const std::vector<std::string>& parameters);

}  // namespace tunica::radial
