// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "axisym/problem.hpp"
#include "axisym/resolution.hpp"
#include "core/coupled/loading.hpp"

namespace tunica::axisym {

/// A scene in the terms of this tier. Stays where it was made: the problem's functions refer to it.
struct Setup : coupled::Loading {
  Resolution resolution;
  Problem problem;
};

/// Throws InvalidInput for a scene that this tier cannot compute.
std::unique_ptr<Setup> setup_of(const Scene& scene);
/// The same with other numbers of cells than the scene asks for.
std::unique_ptr<Setup> setup_of(const Scene& scene, const Resolution& resolution);
/// The same without what is expected of the solution: ring, sizes and steady state.
std::unique_ptr<Setup> conditions_of(const Scene& scene, const Resolution& resolution);

}  // namespace tunica::axisym
