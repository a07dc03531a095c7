// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/rigid_motions.hpp"

#include <Eigen/Eigenvalues>
#include <array>

namespace tunica::full3d {

namespace {

/// Displacement of a place by a translation along an axis (0 to 2) or a rotation about it (3 to 5), by its
/// component.
double rigid_motion(int motion, const Point& x, int component) {
  const int axis = motion % 3;
  if (motion < 3) return component == axis ? 1 : 0;
  if (component == (axis + 1) % 3) return -x[(axis + 2) % 3];
  return component == (axis + 2) % 3 ? x[(axis + 1) % 3] : 0;
}

}  // namespace

OwnedNullSpace rigid_motions(const std::vector<PlacedComponent>& rows, MPI_Comm communicator) {
  std::array<OwnedVector, 6> motions;
  std::vector<Vec> found;
  for (int m = 0; m < 6; ++m) {
    check(VecCreateMPI(communicator, static_cast<PetscInt>(rows.size()), PETSC_DETERMINE, motions[m].put()),
          "VecCreateMPI");
    PetscScalar* values = nullptr;
    check(VecGetArray(motions[m].get(), &values), "VecGetArray");
    for (std::size_t k = 0; k < rows.size(); ++k)
      values[k] = rigid_motion(m, *rows[k].place, rows[k].component);
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

std::vector<std::vector<double>> free_rigid_motions(const Problem& problem, const Layout& layout,
                                                    std::span<const double> y) {
  constexpr int count = 6;
  const Mesh& mesh = problem.mesh;
  // From their mean, so that turns are told from shifts wherever the vessel is.
  Point centre{};
  for (const int node : layout.wall_nodes())
    for (int i = 0; i < 3; ++i)
      centre[i] += mesh.points[node][i] / static_cast<double>(layout.wall_nodes().size());
  const auto place = [&](int node) {
    Point x = mesh.points[node];
    for (int i = 0; i < 3; ++i) x[i] += y[layout.displacement(node, i)] - centre[i];
    return x;
  };
  Eigen::Matrix<double, count, count> moved = Eigen::Matrix<double, count, count>::Zero(), held = moved;
  for (const int node : layout.wall_nodes())
    for (int c = 0; c < 3; ++c) {
      Eigen::Matrix<double, count, 1> values;
      for (int m = 0; m < count; ++m) values[m] = rigid_motion(m, place(node), c);
      moved += values * values.transpose();
      if (layout.unknown(layout.displacement(node, c)) < 0) held += values * values.transpose();
    }
  // Motions by the share of them, summed over components, that prescribed values hold.
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix<double, count, count>> shares(held, moved);
  constexpr double rounding = 1e-12;
  std::vector<std::vector<double>> motions;
  for (int k = 0; k < count && shares.eigenvalues()[k] < rounding; ++k) {
    std::vector<double>& motion = motions.emplace_back(layout.unknowns(), 0.0);
    for (const int node : layout.wall_nodes())
      for (int c = 0; c < 3; ++c) {
        const int unknown = layout.unknown(layout.displacement(node, c));
        if (unknown < 0) continue;
        for (int m = 0; m < count; ++m)
          motion[unknown] += shares.eigenvectors()(m, k) * rigid_motion(m, place(node), c);
      }
  }
  return motions;
}

}  // namespace tunica::full3d
