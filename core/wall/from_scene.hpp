// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/scene/seeded.hpp"
#include "core/wall/law.hpp"

namespace tunica::wall {

/// The layers and laws that a scene describes, from the lumen outwards; one layer when it names none.
/// Instantiated for double and for Dual<double, 1>.
template <class P>
Wall<P> wall_from_scene(const SeededScene<P>& scene);

}  // namespace tunica::wall
