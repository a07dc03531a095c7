// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/pressure_complement.hpp"

#include <cmath>
#include <unordered_map>
#include <utility>

namespace tunica::full3d {

PressureComplement::PressureComplement(Rows rows, MPI_Comm communicator)
    : rows_(std::move(rows)), communicator_(communicator) {}

void PressureComplement::set_mobility(KSP motion, Mat stiffness, Mat gradient, double rate_coefficient) {
  OwnedVector uniform, load, response;
  check(MatCreateVecs(gradient, uniform.put(), load.put()), "MatCreateVecs");
  check(VecDuplicate(load.get(), response.put()), "VecDuplicate");
  if (!mobility_) check(VecDuplicate(load.get(), mobility_.put()), "VecDuplicate");
  if (!(rate_coefficient > 0)) {
    // Nothing moves: what resists is stiffness and viscosity.
    check(MatGetDiagonal(stiffness, mobility_.get()), "MatGetDiagonal");
    check(VecReciprocal(mobility_.get()), "VecReciprocal");
    return;
  }
  using Motion = Rows::Motion;
  PetscScalar* values = nullptr;
  check(VecGetArray(uniform.get(), &values), "VecGetArray");
  for (std::size_t k = 0; k < rows_.volume.size(); ++k) values[k] = rows_.volume[k] > 0 ? 1 : 0;
  check(VecRestoreArray(uniform.get(), &values), "VecRestoreArray");
  check(MatMult(gradient, uniform.get(), load.get()), "MatMult");
  check(VecGetArray(load.get(), &values), "VecGetArray");
  for (std::size_t k = 0; k < rows_.motion.size(); ++k)
    if (rows_.motion[k] != Motion::surface) values[k] = 0;
  check(VecRestoreArray(load.get(), &values), "VecRestoreArray");
  check(KSPSolve(motion, load.get(), response.get()), "KSPSolve");

  // All components of a node belong to one rank.
  struct Work {
    double force = 0, power = 0;
  };
  std::unordered_map<int, Work> nodes;
  const PetscScalar *forces = nullptr, *rates = nullptr;
  check(VecGetArrayRead(load.get(), &forces), "VecGetArrayRead");
  check(VecGetArrayRead(response.get(), &rates), "VecGetArrayRead");
  for (std::size_t k = 0; k < rows_.motion.size(); ++k)
    if (rows_.motion[k] == Motion::surface) {
      Work& work = nodes[rows_.node[k]];
      work.force += forces[k] * forces[k];
      work.power += forces[k] * rates[k];
    }
  check(VecRestoreArrayRead(load.get(), &forces), "VecRestoreArrayRead");
  check(VecRestoreArrayRead(response.get(), &rates), "VecRestoreArrayRead");
  check(VecGetArray(mobility_.get(), &values), "VecGetArray");
  for (std::size_t k = 0; k < rows_.motion.size(); ++k) {
    values[k] = 0;
    if (rows_.motion[k] == Motion::inside) values[k] = 1 / (rate_coefficient * rows_.mass[k]);
    if (rows_.motion[k] != Motion::surface) continue;
    const Work& work = nodes[rows_.node[k]];
    if (work.power > 0 && work.force > 0) values[k] = work.power / work.force;
  }
  check(VecRestoreArray(mobility_.get(), &values), "VecRestoreArray");
}

void PressureComplement::update(KSP motion, Mat complement, double rate_coefficient,
                                const std::vector<double>& scale) {
  Mat stiffness = nullptr, gradient = nullptr, continuity = nullptr, rest = nullptr;
  check(MatSchurComplementGetSubMatrices(complement, &stiffness, nullptr, &gradient, &continuity, &rest),
        "MatSchurComplementGetSubMatrices");
  set_mobility(motion, stiffness, gradient, rate_coefficient);
  OwnedMatrix flows, product;
  check(MatDuplicate(gradient, MAT_COPY_VALUES, flows.put()), "MatDuplicate");
  check(MatDiagonalScale(flows.get(), mobility_.get(), nullptr), "MatDiagonalScale");
  check(MatMatMult(continuity, flows.get(), MAT_INITIAL_MATRIX, PETSC_DEFAULT, product.put()), "MatMatMult");
  check(MatScale(product.get(), -1), "MatScale");
  check(MatAXPY(product.get(), 1, rest, DIFFERENT_NONZERO_PATTERN), "MatAXPY");
  laplacian_ = std::move(product);

  if (!viscous_) check(MatCreateVecs(laplacian_.get(), part_.put(), viscous_.put()), "MatCreateVecs");
  check(MatGetDiagonal(laplacian_.get(), viscous_.get()), "MatGetDiagonal");
  PetscScalar* values = nullptr;
  check(VecGetArray(viscous_.get(), &values), "VecGetArray");
  for (std::size_t k = 0; k < rows_.volume.size(); ++k)
    values[k] = rows_.volume[k] > 0
                    ? std::copysign(2 * rows_.viscosity / (scale[k] * rows_.volume[k]), values[k])
                    : 0;
  check(VecRestoreArray(viscous_.get(), &values), "VecRestoreArray");

  if (!solver_) {
    check(KSPCreate(communicator_, solver_.put()), "KSPCreate");
    check(KSPSetOptionsPrefix(solver_.get(), "fieldsplit_pressure_laplacian_"), "KSPSetOptionsPrefix");
    check(KSPSetFromOptions(solver_.get()), "KSPSetFromOptions");
  }
  check(KSPSetOperators(solver_.get(), laplacian_.get(), laplacian_.get()), "KSPSetOperators");
  check(KSPSetUp(solver_.get()), "KSPSetUp");
}

PetscErrorCode PressureComplement::apply(Vec right, Vec solution) const {
  PetscCall(KSPSolve(solver_.get(), right, solution));
  PetscCall(VecPointwiseMult(part_.get(), viscous_.get(), right));
  PetscCall(VecAXPY(solution, 1, part_.get()));
  return 0;
}

void PressureComplement::give_to(PC shell) {
  check(PCShellSetContext(shell, this), "PCShellSetContext");
  check(PCShellSetName(shell, "pressure complement"), "PCShellSetName");
  check(PCShellSetApply(shell,
                        [](PC pc, Vec right, Vec solution) -> PetscErrorCode {
                          void* context = nullptr;
                          PetscCall(PCShellGetContext(pc, &context));
                          return static_cast<const PressureComplement*>(context)->apply(right, solution);
                        }),
        "PCShellSetApply");
}

}  // namespace tunica::full3d
