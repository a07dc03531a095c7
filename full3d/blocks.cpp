// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/blocks.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "full3d/rigid_motions.hpp"

namespace tunica::full3d {

Blocks::Blocks(const Layout& layout, const std::vector<int>& own, MPI_Comm communicator)
    : communicator_(communicator), layout_(layout), own_(own) {
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
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM,
                          communicator_),
            "MPI_Allreduce");
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

namespace {

bool is_of_type(PC pc, PCType type) {
  PetscBool is = PETSC_FALSE;
  check(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(pc), type, &is), "PetscObjectTypeCompare");
  return is == PETSC_TRUE;
}

/// The solvers of the two blocks of a Schur complement.
std::array<KSP, 2> solvers_of(PC pc) {
  PetscInt count = 0;
  KSP* solvers = nullptr;
  check(PCFieldSplitGetSubKSP(pc, &count, &solvers), "PCFieldSplitGetSubKSP");
  const std::array<KSP, 2> both{solvers[0], solvers[1]};
  check(PetscFree(solvers), "PetscFree");
  return both;
}

PC preconditioner(KSP solver) {
  PC pc = nullptr;
  check(KSPGetPC(solver, &pc), "KSPGetPC");
  return pc;
}

int component_of(const Layout& layout, std::size_t entry) {
  const std::size_t begin = entry >= layout.velocity_begin() ? layout.velocity_begin() : 0;
  return static_cast<int>((entry - begin) % layout.components());
}

}  // namespace

void Blocks::split(PC pc, const Mesh& vessel, const BloodVolumes& volumes) {
  if (!is_of_type(pc, PCFIELDSPLIT)) return;
  std::vector<PetscInt> motion, pressure, mesh, velocity;
  std::vector<PlacedComponent> components;  // of velocity
  PressureComplement::Rows rows;
  rows.viscosity = volumes.viscosity;
  // The layout finds the node of a pressure by a search.
  std::vector<double> volume_of_pressure(layout_.pressures());
  for (int node = 0; node < layout_.nodes(); ++node)
    if (layout_.has_pressure(node))
      volume_of_pressure[layout_.pressure(node) - layout_.pressure_begin()] = volumes.pressure[node];
  std::array<int, 2> own{static_cast<int>(field_.size()), 0}, begin{};
  for (const Field field : field_)
    if (field < Field::pressure) ++own[1];
  check_mpi(MPI_Exscan(own.data(), begin.data(), 2, MPI_INT, MPI_SUM, communicator_), "MPI_Exscan");
  for (std::size_t k = 0; k < field_.size(); ++k) {
    const auto row = begin[0] + static_cast<PetscInt>(k);
    const std::size_t entry = layout_.entry(own_[k]);
    if (field_[k] >= Field::pressure) {
      pressure.push_back(row);
      rows.volume.push_back(
          field_[k] == Field::scalar ? 0 : volume_of_pressure[entry - layout_.pressure_begin()]);
      continue;
    }
    const int node = layout_.node_of(entry);
    // Blocks within motion are numbered as its rows.
    (field_[k] == Field::mesh ? mesh : velocity).push_back(begin[1] + static_cast<PetscInt>(motion.size()));
    if (field_[k] != Field::mesh) components.push_back({&vessel.points[node], component_of(layout_, entry)});
    motion.push_back(row);
    rows.node.push_back(node);
    rows.mass.push_back(volumes.density * volumes.velocity[node]);
    using Motion = PressureComplement::Rows::Motion;
    rows.motion.push_back(field_[k] == Field::velocity                             ? Motion::inside
                          : field_[k] == Field::wall && volumes.velocity[node] > 0 ? Motion::surface
                                                                                   : Motion::other);
  }
  check(PCFieldSplitSetIS(pc, "motion", indices(motion).get()), "PCFieldSplitSetIS");
  check(PCFieldSplitSetIS(pc, "pressure", indices(pressure).get()), "PCFieldSplitSetIS");
  check(PCSetUp(pc), "PCSetUp");
  const auto [of_motion, of_pressure] = solvers_of(pc);
  check(KSPSetFromOptions(of_motion), "KSPSetFromOptions");
  check(KSPSetFromOptions(of_pressure), "KSPSetFromOptions");
  const PC inner = preconditioner(of_motion);
  if (is_of_type(inner, PCFIELDSPLIT)) {
    check(PCFieldSplitSetIS(inner, "mesh", indices(mesh).get()), "PCFieldSplitSetIS");
    const OwnedIndices of_velocity = indices(velocity);
    const OwnedNullSpace rigid = rigid_motions(components, communicator_);
    check(PetscObjectCompose(reinterpret_cast<PetscObject>(of_velocity.get()), "nearnullspace",
                             reinterpret_cast<PetscObject>(rigid.get())),
          "PetscObjectCompose");
    check(PCFieldSplitSetIS(inner, "velocity", of_velocity.get()), "PCFieldSplitSetIS");
  }
  if (const PC shell = preconditioner(of_pressure); is_of_type(shell, PCSHELL)) {
    complement_ = std::make_unique<PressureComplement>(std::move(rows), communicator_);
    complement_->give_to(shell);
  }
}

void Blocks::update(PC pc, double rate_coefficient) {
  if (!complement_) return;
  const auto [of_motion, of_pressure] = solvers_of(pc);
  check(KSPSetUp(of_motion), "KSPSetUp");
  Mat complement = nullptr;
  check(KSPGetOperators(of_pressure, &complement, nullptr), "KSPGetOperators");
  const PetscScalar *row = nullptr, *column = nullptr;
  std::vector<double> scale;
  check(VecGetArrayRead(rows_.get(), &row), "VecGetArrayRead");
  check(VecGetArrayRead(columns_.get(), &column), "VecGetArrayRead");
  for (std::size_t k = 0; k < field_.size(); ++k)
    if (field_[k] >= Field::pressure) scale.push_back(row[k] * column[k]);
  check(VecRestoreArrayRead(columns_.get(), &column), "VecRestoreArrayRead");
  check(VecRestoreArrayRead(rows_.get(), &row), "VecRestoreArrayRead");
  complement_->update(of_motion, complement, rate_coefficient, scale);
}

}  // namespace tunica::full3d
