// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "full3d/petsc.hpp"

namespace tunica::full3d {

/// A preconditioner for the Schur complement of pressure, S = D - C A^-1 B with the equations of motion A,
/// the gradient B and the continuity C:
///
///   S^-1 ~ L^-1 - 2 mu / m,   L = D - C a^-1 B,
///
/// with the viscosity mu and the volumes m of the pressures' shape functions (J. Cahouet, J.-P. Chabard 1988;
/// 2 mu since viscosity acts on the symmetric gradient). The diagonal a is what resists pressure at once:
/// inside the blood its inertia, density times rate coefficient times volume; on the wall its stiffness
/// against a uniform pressure, found by a solution with A's own preconditioner. L is then a Laplacian of
/// pressure with the wall's compliance as Robin condition, and holds the scalars of inlet and outlet, which
/// are rows of C.
class PressureComplement {
 public:
  /// What the rank's rows are, in their order.
  struct Rows {
    enum class Motion { inside, surface, other };
    std::vector<Motion> motion;  ///< in the blood, on the wall that it touches, elsewhere
    std::vector<int> node;       ///< of the rows of motion
    std::vector<double> mass;    ///< of blood at the rows of motion, g
    std::vector<double> volume;  ///< of the rows of pressure, cm3; 0 for scalars
    double viscosity = 0;        ///< of blood, g/cm/s
  };

  PressureComplement(Rows rows, MPI_Comm communicator);

  /// Follows a change of the matrix. `motion` solves with A; `scale` is what the volumes of `Rows` have been
  /// multiplied by when the matrix was scaled, by the rows of pressure.
  void update(KSP motion, Mat complement, double rate_coefficient, const std::vector<double>& scale);
  /// Makes a PCSHELL apply it; it must then outlive it.
  void give_to(PC shell);

 private:
  void set_mobility(KSP motion, Mat stiffness, Mat gradient, double rate_coefficient);
  PetscErrorCode apply(Vec right, Vec solution) const;

  Rows rows_;
  MPI_Comm communicator_;
  OwnedVector mobility_;        ///< 1 / a
  OwnedVector viscous_, part_;  ///< 2 mu / m, and its part of a solution
  OwnedMatrix laplacian_;
  OwnedSolver solver_;
};

}  // namespace tunica::full3d
