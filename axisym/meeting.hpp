// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "axisym/locate.hpp"

namespace tunica::axisym {

/// The cells of the place's part that meet there, sorted, with the place in each of them: several where it
/// lies on a side or at a corner (to 1e-7 of the local coordinates).
std::vector<Place> meeting_places(const Mesh& mesh, const Place& place);

/// Those of the places that lie in the innermost layer among them, to which a boundary of layers belongs.
std::vector<Place> in_innermost_layer(const Mesh& mesh, std::vector<Place> places);

/// True when the local point lies on a side of the reference cell, likewise.
bool on_side(CellShape shape, int side, const element::Local& local);

}  // namespace tunica::axisym
