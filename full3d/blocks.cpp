// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/blocks.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace tunica::full3d {

Blocks::Blocks(const Layout& layout, const std::vector<int>& own, MPI_Comm communicator)
    : communicator_(communicator) {
  field_.reserve(own.size());
  for (const int u : own) {
    const std::size_t entry = layout.entry(u);
    if (entry >= layout.scalar_begin())
      field_.push_back(Field::scalar);
    else if (entry >= layout.pressure_begin())
      field_.push_back(Field::pressure);
    else if (entry >= layout.velocity_begin())
      field_.push_back(Field::velocity);
    else
      field_.push_back(layout.on_wall(layout.node_of(entry)) ? Field::wall : Field::mesh);
  }
}

void Blocks::scale(double rate_coefficient, Mat matrix) {
  if (!rows_) check(MatCreateVecs(matrix, columns_.put(), rows_.put()), "MatCreateVecs");
  const double rate = rate_coefficient > 0 ? rate_coefficient : 1;
  // Logarithmic means over all rows: of the diagonals by field, and of the greatest entries of gradient and
  // flow in each row of the blood's momentum.
  enum { wall_diagonal, mesh_diagonal, velocity_diagonal, gradient, means };
  std::array<double, 2 * means> sums{};  // and counts
  const auto note = [&](int mean, double value) {
    if (!(value > 0)) return;
    sums[mean] += std::log(value);
    sums[means + mean] += 1;
  };
  PetscInt begin = 0, end = 0;
  check(MatGetOwnershipRange(matrix, &begin, &end), "MatGetOwnershipRange");
  check(MatGetDiagonal(matrix, rows_.get()), "MatGetDiagonal");
  const PetscScalar* diagonal = nullptr;
  check(VecGetArrayRead(rows_.get(), &diagonal), "VecGetArrayRead");
  for (std::size_t k = 0; k < field_.size(); ++k) {
    const double size = std::abs(diagonal[k]);
    if (field_[k] == Field::wall) note(wall_diagonal, size / rate);
    if (field_[k] == Field::mesh) note(mesh_diagonal, size / rate);
    if (field_[k] == Field::velocity) note(velocity_diagonal, size);
  }
  check(VecRestoreArrayRead(rows_.get(), &diagonal), "VecRestoreArrayRead");
  std::vector<double> greatest(field_.size(), 0.0);
  for (std::size_t k = 0; k < field_.size(); ++k) {
    if (field_[k] < Field::pressure) continue;
    PetscInt count = 0;
    const PetscScalar* values = nullptr;
    const auto row = begin + static_cast<PetscInt>(k);
    check(MatGetRow(matrix, row, &count, nullptr, &values), "MatGetRow");
    for (PetscInt j = 0; j < count; ++j) greatest[k] = std::max(greatest[k], std::abs(values[j]));
    check(MatRestoreRow(matrix, row, &count, nullptr, &values), "MatRestoreRow");
    // Rows of continuity hold the transposed gradient.
    if (field_[k] == Field::pressure) note(gradient, greatest[k]);
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM, communicator_);
  const auto mean = [&](int m) { return sums[means + m] > 0 ? std::exp(sums[m] / sums[means + m]) : 1.0; };
  const double momentum = sums[means + velocity_diagonal] > 0 ? mean(velocity_diagonal) : mean(wall_diagonal);
  const double pressure = momentum / mean(gradient);
  PetscScalar *row = nullptr, *column = nullptr;
  check(VecGetArray(rows_.get(), &row), "VecGetArray");
  check(VecGetArray(columns_.get(), &column), "VecGetArray");
  for (std::size_t k = 0; k < field_.size(); ++k) {
    const Field field = field_[k];
    row[k] = field == Field::mesh       ? momentum / mean(mesh_diagonal)
             : field == Field::pressure ? pressure
             : field == Field::scalar   ? momentum / (greatest[k] > 0 ? greatest[k] : 1)
                                        : 1;
    column[k] = field == Field::wall || field == Field::mesh ? 1 / rate
                : field == Field::velocity                   ? 1
                                                             : pressure;
  }
  check(VecRestoreArray(rows_.get(), &row), "VecRestoreArray");
  check(VecRestoreArray(columns_.get(), &column), "VecRestoreArray");
  check(MatDiagonalScale(matrix, rows_.get(), columns_.get()), "MatDiagonalScale");
}

void Blocks::scale_right(Vec right) const {
  check(VecPointwiseMult(right, right, rows_.get()), "VecPointwiseMult");
}

void Blocks::unscale_solution(Vec solution) const {
  check(VecPointwiseMult(solution, solution, columns_.get()), "VecPointwiseMult");
}

OwnedIndices Blocks::indices(const std::vector<PetscInt>& list) const {
  OwnedIndices indices;
  check(ISCreateGeneral(communicator_, static_cast<PetscInt>(list.size()), list.data(), PETSC_COPY_VALUES,
                        indices.put()),
        "ISCreateGeneral");
  return indices;
}

void Blocks::split(PC pc) const {
  const auto is_split = [](PC of) {
    PetscBool split = PETSC_FALSE;
    check(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(of), PCFIELDSPLIT, &split),
          "PetscObjectTypeCompare");
    return split == PETSC_TRUE;
  };
  if (!is_split(pc)) return;
  std::vector<PetscInt> motion, pressure, mesh, velocity;
  std::array<int, 2> own{static_cast<int>(field_.size()), 0}, begin{};
  for (const Field field : field_)
    if (field < Field::pressure) ++own[1];
  MPI_Exscan(own.data(), begin.data(), 2, MPI_INT, MPI_SUM, communicator_);
  for (std::size_t k = 0; k < field_.size(); ++k) {
    const auto row = begin[0] + static_cast<PetscInt>(k);
    if (field_[k] >= Field::pressure) {
      pressure.push_back(row);
      continue;
    }
    // Blocks within motion are numbered as its rows.
    (field_[k] == Field::mesh ? mesh : velocity).push_back(begin[1] + static_cast<PetscInt>(motion.size()));
    motion.push_back(row);
  }
  check(PCFieldSplitSetIS(pc, "motion", indices(motion).get()), "PCFieldSplitSetIS");
  check(PCFieldSplitSetIS(pc, "pressure", indices(pressure).get()), "PCFieldSplitSetIS");
  check(PCSetUp(pc), "PCSetUp");
  PetscInt count = 0;
  KSP* solvers = nullptr;
  check(PCFieldSplitGetSubKSP(pc, &count, &solvers), "PCFieldSplitGetSubKSP");
  PC inner = nullptr;
  check(KSPSetFromOptions(solvers[0]), "KSPSetFromOptions");
  check(KSPGetPC(solvers[0], &inner), "KSPGetPC");
  check(PetscFree(solvers), "PetscFree");
  if (!is_split(inner)) return;
  check(PCFieldSplitSetIS(inner, "mesh", indices(mesh).get()), "PCFieldSplitSetIS");
  check(PCFieldSplitSetIS(inner, "velocity", indices(velocity).get()), "PCFieldSplitSetIS");
}

}  // namespace tunica::full3d
