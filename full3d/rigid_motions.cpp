// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/rigid_motions.hpp"

#include <array>

namespace tunica::full3d {

OwnedNullSpace rigid_motions(const std::vector<PlacedComponent>& rows, MPI_Comm communicator) {
  std::array<OwnedVector, 6> motions;
  std::vector<Vec> found;
  for (int m = 0; m < 6; ++m) {
    check(VecCreateMPI(communicator, static_cast<PetscInt>(rows.size()), PETSC_DETERMINE, motions[m].put()),
          "VecCreateMPI");
    PetscScalar* values = nullptr;
    check(VecGetArray(motions[m].get(), &values), "VecGetArray");
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const int c = rows[k].component, axis = m % 3;
      const Point& x = *rows[k].place;
      if (m < 3)
        values[k] = c == axis ? 1 : 0;
      else
        values[k] = c == (axis + 1) % 3 ? -x[(axis + 2) % 3] : c == (axis + 2) % 3 ? x[(axis + 1) % 3] : 0;
    }
    check(VecRestoreArray(motions[m].get(), &values), "VecRestoreArray");
    for (const Vec other : found) {
      PetscScalar along = 0;
      check(VecDot(motions[m].get(), other, &along), "VecDot");
      check(VecAXPY(motions[m].get(), -along, other), "VecAXPY");
    }
    PetscReal length = 0;
    check(VecNormalize(motions[m].get(), &length), "VecNormalize");
    if (length > 0) found.push_back(motions[m].get());
  }
  OwnedNullSpace space;
  check(MatNullSpaceCreate(communicator, PETSC_FALSE, static_cast<PetscInt>(found.size()), found.data(),
                           space.put()),
        "MatNullSpaceCreate");
  return space;
}

}  // namespace tunica::full3d
