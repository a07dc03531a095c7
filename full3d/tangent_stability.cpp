// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/tangent_stability.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "full3d/rigid_motions.hpp"

namespace tunica::full3d {

namespace {

/// A copy of the share's matrix, the symmetric part of it.
OwnedMatrix symmetric_part(Mat matrix) {
  OwnedMatrix transposed, sum;
  check(MatTranspose(matrix, MAT_INITIAL_MATRIX, transposed.put()), "MatTranspose");
  check(MatDuplicate(matrix, MAT_COPY_VALUES, sum.put()), "MatDuplicate");
  check(MatAXPY(sum.get(), 1, transposed.get(), DIFFERENT_NONZERO_PATTERN), "MatAXPY");
  check(MatScale(sum.get(), 0.5), "MatScale");
  return sum;
}

class StiffnessAndMass final : public coupled::StiffnessAndMass {
 public:
  StiffnessAndMass(Share& share, const Ranks& ranks, LoadedStage at, std::span<const double> y,
                   const std::vector<std::vector<double>>& free)
      : free_(by_row(share, free)) {
    at.stage.coefficient = 0;
    share.assemble(at, y);
    stiffness_ = symmetric_part(share.matrix());
    at.stage.coefficient = coefficient;
    share.assemble(at, y);
    mass_ = symmetric_part(share.matrix());
    check(MatAXPY(mass_.get(), -1, stiffness_.get(), SAME_NONZERO_PATTERN), "MatAXPY");
    check(MatScale(mass_.get(), 1 / (coefficient * coefficient)), "MatScale");
    check(MatDuplicate(stiffness_.get(), MAT_COPY_VALUES, shifted_.put()), "MatDuplicate");
    check(MatSetOption(shifted_.get(), MAT_SYMMETRIC, PETSC_TRUE), "MatSetOption");
    check(KSPCreate(ranks.communicator(), solver_.put()), "KSPCreate");
    check(KSPSetType(solver_.get(), KSPPREONLY), "KSPSetType");
    check(KSPSetOperators(solver_.get(), shifted_.get(), shifted_.get()), "KSPSetOperators");
    check(KSPGetPC(solver_.get(), &pc_), "KSPGetPC");
    check(PCSetType(pc_, PCCHOLESKY), "PCSetType");
    check(PCFactorSetMatSolverType(pc_, MATSOLVERMUMPS), "PCFactorSetMatSolverType");
    check(PCFactorSetUpMatSolverType(pc_), "PCFactorSetUpMatSolverType");
    // Signs are counted where the last front is not left to ScaLAPACK.
    Mat factors = nullptr;
    check(PCFactorGetMatrix(pc_, &factors), "PCFactorGetMatrix");
    check(MatMumpsSetIcntl(factors, 13, 1), "MatMumpsSetIcntl");
  }

  int negative(double lambda) override {
    check(MatCopy(stiffness_.get(), shifted_.get(), SAME_NONZERO_PATTERN), "MatCopy");
    check(MatAXPY(shifted_.get(), -lambda, mass_.get(), SAME_NONZERO_PATTERN), "MatAXPY");
    check(KSPSetOperators(solver_.get(), shifted_.get(), shifted_.get()), "KSPSetOperators");
    check(KSPSetUp(solver_.get()), "KSPSetUp");
    PCFailedReason reason{};
    check(PCGetFailedReason(pc_, &reason), "PCGetFailedReason");
    Mat factors = nullptr;
    check(PCFactorGetMatrix(pc_, &factors), "PCFactorGetMatrix");
    // The same on all ranks, as MUMPS tells all of them.
    if (reason == PC_FACTOR_NUMERIC_ZEROPIVOT || reason == PC_FACTOR_STRUCT_ZEROPIVOT)
      throw SolverFailure(coupled::vanishing_pivot);
    if (reason != PC_NOERROR)
      throw SolverFailure(
          "stability was not checked: its factors were not computed, for lack of memory most likely");
    PetscInt negative = 0;
    check(MatGetInertia(factors, &negative, nullptr, nullptr), "MatGetInertia");
    return static_cast<int>(negative);
  }

  FreeMotions free_motions() override {
    FreeMotions found{static_cast<int>(free_.size()), 0};
    for (const std::vector<double>& motion : free_)
      found.scale =
          std::max(found.scale, form(stiffness_.get(), motion, true) / form(mass_.get(), motion, false));
    return found;
  }

  /// The motion that changes the slowest, with the latest factors, by own rows.
  std::vector<double> slowest() const {
    OwnedVector motion, pushed;
    check(MatCreateVecs(mass_.get(), motion.put(), pushed.put()), "MatCreateVecs");
    PetscInt begin = 0, end = 0, all = 0;
    check(VecGetOwnershipRange(motion.get(), &begin, &end), "VecGetOwnershipRange");
    check(VecGetSize(motion.get(), &all), "VecGetSize");
    PetscScalar* own = nullptr;
    check(VecGetArray(motion.get(), &own), "VecGetArray");
    for (PetscInt k = begin; k < end; ++k) own[k - begin] = 1 + static_cast<double>(k) / all;
    check(VecRestoreArray(motion.get(), &own), "VecRestoreArray");
    for (int k = 0; k < iterations; ++k) {
      check(MatMult(mass_.get(), motion.get(), pushed.get()), "MatMult");
      check(KSPSolve(solver_.get(), pushed.get(), motion.get()), "KSPSolve");
      check(VecNormalize(motion.get(), nullptr), "VecNormalize");
    }
    const PetscScalar* found = nullptr;
    check(VecGetArrayRead(motion.get(), &found), "VecGetArrayRead");
    std::vector<double> rows(all, 0.0);
    std::copy(found, found + (end - begin), rows.begin() + begin);
    check(VecRestoreArrayRead(motion.get(), &found), "VecRestoreArrayRead");
    return rows;
  }

 private:
  /// Motions by PETSc's rows.
  static std::vector<std::vector<double>> by_row(const Share& share,
                                                 const std::vector<std::vector<double>>& motions) {
    std::vector<std::vector<double>> all;
    for (const std::vector<double>& motion : motions) {
      std::vector<double>& rows = all.emplace_back(motion.size(), 0.0);
      for (std::size_t u = 0; u < motion.size(); ++u)
        rows[share.petsc_index(static_cast<int>(u))] = motion[u];
    }
    return all;
  }

  /// x.A x, or |x|.|A| |x|, the same on all ranks.
  static double form(Mat matrix, const std::vector<double>& motion, bool absolute) {
    OwnedVector left, right;
    check(MatCreateVecs(matrix, left.put(), right.put()), "MatCreateVecs");
    PetscInt begin = 0, end = 0;
    check(MatGetOwnershipRange(matrix, &begin, &end), "MatGetOwnershipRange");
    for (PetscInt row = begin; row < end; ++row) {
      PetscInt count = 0;
      const PetscInt* columns = nullptr;
      const PetscScalar* values = nullptr;
      check(MatGetRow(matrix, row, &count, &columns, &values), "MatGetRow");
      double sum = 0;
      for (PetscInt k = 0; k < count; ++k) {
        const double term = values[k] * motion[columns[k]];
        sum += absolute ? std::abs(term) : term;
      }
      check(MatRestoreRow(matrix, row, &count, &columns, &values), "MatRestoreRow");
      check(VecSetValue(right.get(), row, sum, INSERT_VALUES), "VecSetValue");
      check(VecSetValue(left.get(), row, absolute ? std::abs(motion[row]) : motion[row], INSERT_VALUES),
            "VecSetValue");
    }
    for (Vec vector : {left.get(), right.get()}) {
      check(VecAssemblyBegin(vector), "VecAssemblyBegin");
      check(VecAssemblyEnd(vector), "VecAssemblyEnd");
    }
    PetscScalar product = 0;
    check(VecDot(left.get(), right.get(), &product), "VecDot");
    return product;
  }

  std::vector<std::vector<double>> free_;
  OwnedMatrix stiffness_, mass_, shifted_;
  OwnedSolver solver_;
  PC pc_ = nullptr;
};

}  // namespace

LeastMode least_mode(Share& share, const Problem& problem, const Layout& layout, const Ranks& ranks,
                     const LoadedStage& at, std::span<const double> y) {
  StiffnessAndMass pencil(share, ranks, at, y, free_rigid_motions(problem, layout, y));
  LeastMode mode;
  mode.stability = coupled::least_mode(pencil);
  std::vector<double> rows = pencil.slowest();
  ranks.sum_to_leader(rows);
  mode.motion.resize(layout.unknowns());
  for (int u = 0; u < layout.unknowns(); ++u) mode.motion[u] = rows[share.petsc_index(u)];
  return mode;
}

double wave_length(const Problem& problem, const Layout& layout, const VesselShape& shape,
                   const std::vector<double>& motion) {
  const Mesh& mesh = problem.mesh;
  const auto basis = displacement_basis(problem.discretisation.element);
  struct Place {
    double angle, s, displacement;
  };
  std::vector<Place> places;
  for (const Face& face : mesh.faces) {
    if (face.boundary != Boundary::interface) continue;
    for (const int k : element::solid::face_nodes(mesh.shape, basis, face.face)) {
      const int node = mesh.node(face.cell, basis, k);
      const auto at = shape.local(mesh.points[node]);
      const double angle = std::atan2(at.y, at.x);
      const auto [circumferential, axial] = shape.axes(angle, at.s);
      const Vector<double> radial = cross(circumferential, axial);
      double displacement = 0;
      for (int c = 0; c < 3; ++c)
        if (const int u = layout.unknown(layout.displacement(node, c)); u >= 0)
          displacement += radial[c] * motion[u];
      places.push_back({angle, at.s, displacement});
    }
  }
  const auto greatest = std::max_element(places.begin(), places.end(), [](const Place& a, const Place& b) {
    return std::abs(a.displacement) < std::abs(b.displacement);
  });
  if (greatest == places.end()) return 0;
  std::vector<std::pair<double, double>> line;
  for (const Place& place : places)
    if (std::abs(place.angle - greatest->angle) < 1e-6) line.emplace_back(place.s, place.displacement);
  return coupled::wave_length(std::move(line));
}

}  // namespace tunica::full3d
