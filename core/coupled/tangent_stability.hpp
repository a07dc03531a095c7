// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

#include "core/physics/tether.hpp"
#include "core/tier.hpp"

namespace tunica::coupled {

/// Linear stability of a static state of a wall alone, from its stiffness K and mass M on the whole mesh.
/// Tethers and pressures that follow the surface may make K unsymmetric (`current` does); a positive
/// symmetric part then still means stability, a negative one no longer proves the contrary.
struct TangentStability {
  /// Negative pivots of the factorised symmetric part of K: as many independent motions give energy back
  /// (Sylvester's law of inertia).
  int negative = 0;
  /// Rigid motions that the conditions leave free and nothing resists: lambda is what rounding leaves of 0.
  int neutral = 0;
  /// Least lambda, but for neutral motions, of K x = lambda M x, 1/s^2, K's symmetric part: found by
  /// bisection on the number of negative pivots of K - lambda M, to 1 %. A motion of negative lambda grows as
  /// e^(sqrt(-lambda) t).
  double least_eigenvalue = 0;
  /// Twice the mean distance between the nodes of that motion's radial displacement along the inner surface,
  /// cm; 0 when it has fewer than two.
  double wave_length = 0;
};

/// K's symmetric part and M.
class StiffnessAndMass {
 public:
  /// The inertia of the wall enters a derivative of the residual as c^2 M: coefficient c (1/s) beside which
  /// all else vanishes.
  static constexpr double coefficient = 1e6;
  /// Inverse iterations that leave of any motion that which changes the slowest.
  static constexpr int iterations = 30;

  virtual ~StiffnessAndMass() = default;
  /// Factorises K - lambda M and counts its negative pivots. Throws SolverFailure when a pivot vanishes.
  virtual int negative(double lambda) = 0;

  /// Rigid motions that the conditions leave free: a tube on rollers may shift sideways and turn about
  /// itself. Their energy is r.K r = 0 for loads that follow, of which rounding leaves up to eps |r|.|K| |r|.
  struct FreeMotions {
    int count = 0;
    double scale = 0;  ///< the greatest |r|.|K| |r| / r.M r, 1/s^2
  };
  virtual FreeMotions free_motions() { return {}; }
};

/// All but the wave length. With free motions, eigenvalues closer to 0 than 100 eps times their scale are not
/// told from it: assembly and factors leave about one eps, and what grows as slowly as that takes longer than
/// a beat. Leaves factors of K - lambda M with lambda just below the least eigenvalue.
TangentStability least_mode(StiffnessAndMass& pencil);

/// Wave length of a displacement by places along the inner surface.
double wave_length(std::vector<std::pair<double, double>> line);

/// Tells what was found: numbers for record.resolution and a finding when the state is not stable.
void record_stability(const TangentStability& found, radial::TetherTraction tether, RunRecord& record);

/// What SolverFailure says of a pivot that vanishes.
inline constexpr const char* vanishing_pivot =
    "the stability of the state could not be told: a pivot of its stiffness vanishes";

}  // namespace tunica::coupled
