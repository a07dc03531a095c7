// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/mesh_follower.hpp"

#include <algorithm>
#include <vector>

#include "core/error.hpp"

namespace tunica::full3d {

MeshFollower::MeshFollower(const Layout& layout, const CellWork& all_cells, bool direct)
    : layout_(layout), cells_(all_cells), extension_(layout) {
  cells_.add_mesh(extension_);
  extension_.finish();
  // Symmetric: columns are rows.
  auto& among = const_cast<coupled::MeshExtension::Matrix&>(extension_.among());
  const auto rows = static_cast<PetscInt>(among.rows());
  check(MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, rows, rows, among.outerIndexPtr(), among.innerIndexPtr(),
                                  among.valuePtr(), matrix_.put()),
        "MatCreateSeqAIJWithArrays");
  check(MatSetOption(matrix_.get(), MAT_SPD, PETSC_TRUE), "MatSetOption");
  check(MatCreateVecs(matrix_.get(), solution_.put(), right_.put()), "MatCreateVecs");
  check(KSPCreate(PETSC_COMM_SELF, solver_.put()), "KSPCreate");
  check(KSPSetOperators(solver_.get(), matrix_.get(), matrix_.get()), "KSPSetOperators");
  PC pc = nullptr;
  check(KSPGetPC(solver_.get(), &pc), "KSPGetPC");
  if (direct) {
    check(KSPSetType(solver_.get(), KSPPREONLY), "KSPSetType");
    check(PCSetType(pc, PCCHOLESKY), "PCSetType");
    check(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS), "PCFactorSetMatSolverType");
  } else {
    constexpr double tolerance = 1e-10;
    check(KSPSetType(solver_.get(), KSPCG), "KSPSetType");
    check(PCSetType(pc, PCHYPRE), "PCSetType");
    check(KSPSetTolerances(solver_.get(), tolerance, PETSC_DEFAULT, PETSC_DEFAULT, 1000), "KSPSetTolerances");
  }
}

void MeshFollower::follow(double time, std::span<double> y) {
  std::vector<double> loads(layout_.followers().size(), 0.0);
  cells_.add_mesh_loads(time, extension_, loads);
  extension_.extend(
      loads, [this](std::span<double> right) { solve(right); }, y);
}

void MeshFollower::solve(std::span<double> right) {
  PetscScalar* to = nullptr;
  check(VecGetArray(right_.get(), &to), "VecGetArray");
  std::copy(right.begin(), right.end(), to);
  check(VecRestoreArray(right_.get(), &to), "VecRestoreArray");
  check(KSPSolve(solver_.get(), right_.get(), solution_.get()), "KSPSolve");
  KSPConvergedReason reason{};
  check(KSPGetConvergedReason(solver_.get(), &reason), "KSPGetConvergedReason");
  if (reason <= 0)
    throw SolverFailure(
        "the motion of the mesh in the blood was not solved; take solver.geometry = \"implicit\"");
  const PetscScalar* from = nullptr;
  check(VecGetArrayRead(solution_.get(), &from), "VecGetArrayRead");
  std::copy(from, from + right.size(), right.begin());
  check(VecRestoreArrayRead(solution_.get(), &from), "VecRestoreArrayRead");
}

}  // namespace tunica::full3d
