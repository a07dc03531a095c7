// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "axisym/assembler.hpp"

namespace tunica::axisym {

/// Linear stability of a static state of a wall alone, from its stiffness K and mass M on the whole mesh.
struct TangentStability {
  /// Negative pivots of the factorised symmetric part of K: as many independent motions give energy back
  /// (Sylvester's law of inertia).
  int negative = 0;
  /// Least lambda of K x = lambda M x, 1/s^2, K's symmetric part: found by bisection on the number of
  /// negative pivots of K - lambda M, to 1 %. A motion of negative lambda grows as e^(sqrt(-lambda) t).
  double least_eigenvalue = 0;
  /// Twice the mean distance between the nodes of that motion's radial displacement along the inner surface,
  /// cm; 0 when it has fewer than two.
  double wave_length = 0;
};

/// At a complete static state `y`. Tethers and pressures that follow the surface may make K unsymmetric
/// (`current` does); a positive symmetric part then still means stability, a negative one no longer proves
/// the contrary. Throws std::logic_error for a problem with blood, SolverFailure when a pivot vanishes.
TangentStability tangent_stability(const Assembler& assembler, double time, std::span<const double> y);

}  // namespace tunica::axisym
