// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "axisym/setup.hpp"
#include "core/scene/scene.hpp"

namespace tunica::axisym {

/// Lines on the keys that the scene sets although this tier leaves them out, or does in this mode.
std::vector<std::string> remarks_on_unused_keys(const Scene& scene, const Setup& setup);

}  // namespace tunica::axisym
