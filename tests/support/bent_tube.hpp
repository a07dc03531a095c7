// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numbers>
#include <vector>

#include "core/observables/field_series.hpp"

namespace tunica::test_support {

/// A made-up vessel of hexahedra with blood and a wall of two layers that share no points, for tests of what
/// shows fields. Nothing is solved: it swells as sin^2(pi t / 0.8 s), most at mid-length.
struct BentTube {
  double length = 0.66;        ///< cm, along the centreline
  double bend = 1.2;           ///< rad, in the plane y = 0; 0 for a straight tube along z
  int per_side = 4;            ///< cells along each side of the blood's square; four times that around
  int through = 4;             ///< cells through the wall
  int along = 16;              ///< cells
  bool is_quarter = false;     ///< x >= 0 and y >= 0 only, of a straight tube: mirrored at both planes
  bool is_half = false;        ///< y >= 0 only: mirrored there
  bool of_tetrahedra = false;  ///< six for each hexahedron
  int frames = 9;              ///< from 0 to 0.8 s
  double displacement = 0.01;  ///< cm, the largest
};
inline constexpr double tube_inner = 0.033, tube_outer = 0.045;  ///< cm, radii of the wall

/// sin^2(pi t / 0.8 s).
double swelling(double time);

/// "blood": displacement, velocity, pressure = (80 + 40 swelling) mmHg everywhere. "wall": cell field layer,
/// displacement, von_mises, circumferential_stress, recruitment (NaN in the outer layer), fiber_stretch,
/// fiber_direction.
std::vector<observables::FieldSeries> bent_tube(const BentTube& wanted);

}  // namespace tunica::test_support
