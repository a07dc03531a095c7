// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/coupled/newton.hpp"
#include "core/radial/ring.hpp"

namespace tunica::coupled {

/// Why Newton's method did not solve a stage and where, to be asked right after it gave up: the most
/// compressed cell when it is near to turning inside out, else the place that is farthest from a solution.
/// Places are those in the unloaded vessel.
std::string explain(const Equations& equations, const NewtonReport& report);

/// Field and place of an entry of the state: "wall's displacement at r = ...".
std::string place_of(const Equations& equations, std::size_t entry);

/// That a ring of the wall cannot carry a pressure (dyn/cm2), and how much it can, preceded by "; ". Empty
/// when it can or when that is not known.
std::string limit_of_wall(const radial::RingModel* ring, double pressure);

}  // namespace tunica::coupled
