// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/coupled/conditions.hpp"
#include "core/physics/wall_momentum.hpp"

namespace tunica::coupled {

/// What the stress of the wall is computed from.
struct WallStrain {
  Vector<double> displacement{};  ///< d, cm
  Tensor<double> gradient{};      ///< dd/dX
  /// The wall pressure, dyn/cm2, interpolated on its own where tissue is mixed, else the law's own.
  double pressure = 0;

  void add(double factor, const WallStrain& other);
  /// Sets the pressure to that of the law, -V'(theta).
  void take_own_pressure(const wall::Law<double>& law);
};

/// Cauchy stress of a strain and its pressure, dyn/cm2.
Tensor<double> cauchy(const wall::Law<double>& law, const WallStrain& strain, const wall::MaterialAxes& axes);

/// No cell interpolates the pressure of any of these on its own.
bool is_far_from_incompressible(const std::vector<wall::Law<double>>& laws);

/// True where a law has fibres and a mesh leaves open (NaN) one of the directions that they are laid along.
bool lacks_directions(const wall::Law<double>& law, const wall::MaterialAxes& axes);
/// Throws InvalidInput for a cell where that is so; `cell_at` names it and its place.
[[noreturn]] void refuse_fibers(const std::string& cell_at, Element element);

/// Families of a law that do not act like an earlier one where the vessel is its own mirror image, as
/// families of equal |angle| and threshold do.
std::vector<int> distinct_families(const wall::Law<double>& law);

/// Families at negative angles are the mirror images of those at positive ones: the wall is its own mirror
/// image, and does not twist under pressure.
bool is_balanced(const wall::Law<double>& law);

}  // namespace tunica::coupled
