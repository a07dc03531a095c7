// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "full3d/layout.hpp"
#include "full3d/mesh.hpp"
#include "full3d/petsc.hpp"
#include "full3d/pressure_complement.hpp"

namespace tunica::full3d {

/// The blood that nodes of velocity and pressure stand for, by node (cm3), and what it is.
struct BloodVolumes {
  std::vector<double> velocity, pressure;
  double density, viscosity;
};

/// The fields of the coupled equations as blocks of a rank's rows: mesh, the displacement in the blood;
/// velocity, that of the blood continued by the motion of the wall; pressure, with the scalars.
class Blocks {
 public:
  /// `own` are the unknowns of the rank's rows, in their order.
  Blocks(const Layout& layout, const std::vector<int>& own, MPI_Comm communicator);

  /// Brings the fields of a matrix to one unit: unknowns of displacement become their rate, those of pressure
  /// and the rows of each field get the typical size of the blood's momentum. A Krylov method would else see
  /// but one field.
  void scale(double rate_coefficient, Mat matrix);
  /// Of a right-hand side and of a solution, to and from the units of a scaled matrix.
  void scale_right(Vec right) const;
  void unscale_solution(Vec solution) const;

  /// Gives blocks to a PCFIELDSPLIT: "motion" and "pressure", and where motion is split in its turn
  /// "mesh" and "velocity", the latter with rigid motions as near-null space. A PCSHELL for pressure becomes
  /// a PressureComplement. Other preconditioners are left as they are. Needs the operators to be set.
  void split(PC pc, const Mesh& mesh, const BloodVolumes& volumes);
  /// Follows a change of the matrix, which has been scaled.
  void update(PC pc, double rate_coefficient);

 private:
  enum class Field { wall, mesh, velocity, pressure, scalar };
  static constexpr int fields = 5;
  OwnedIndices indices(const std::vector<PetscInt>& list) const;

  MPI_Comm communicator_;
  const Layout& layout_;
  std::vector<int> own_;
  std::vector<Field> field_;  ///< of the rank's rows
  OwnedVector rows_, columns_;
  std::unique_ptr<PressureComplement> complement_;
};

}  // namespace tunica::full3d
