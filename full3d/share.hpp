// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "full3d/blocks.hpp"
#include "full3d/cell_work.hpp"
#include "full3d/petsc.hpp"
#include "full3d/ranks.hpp"

namespace tunica::full3d {

/// How linear systems are solved: a named set of PETSc options, or "auto", and further ones that go before
/// it.
struct SolverChoice {
  std::string name = "direct";
  std::string options;
  bool condense = true;        ///< bubbles, cell by cell
  bool mesh_is_given = false;  ///< the mesh is none of the unknowns
};

/// What one rank does for the coupled equations: its cells, its rows of the matrix and its part of the
/// solver. Every rank knows the whole problem, state and layout; calls are collective, and what they give
/// is on the leader.
class Share {
 public:
  /// Problem and layout must outlive it.
  Share(const Problem& problem, const Layout& layout, const Ranks& ranks, SolverChoice choice);
  ~Share();
  Share(const Share&) = delete;
  Share& operator=(const Share&) = delete;

  LeastJacobian residual(const LoadedStage& stage, std::span<const double> y, std::span<double> residual);
  /// Computes the matrix and prepares solutions with it. False when it is singular. Throws SolverFailure, on
  /// all ranks, when memory runs out.
  bool factorise(const LoadedStage& stage, std::span<const double> y);
  /// The right-hand side is read, and the solution written, on the leader.
  bool solve(std::span<double> right_hand_side);

  double entries() const { return entries_; }
  /// Of Krylov methods: in all, and for the latest solution.
  long iterations() const { return iterations_; }
  long solutions() const { return solutions_; }  ///< with Krylov methods
  long latest_iterations() const { return latest_iterations_; }
  /// Time in residuals and matrices so far, the sums over ranks included, s.
  double assembly_seconds() const { return assembly_seconds_; }
  const std::string& method() const { return choice_.name; }
  const SolverChoice& choice() const { return choice_; }
  const CellWork& work() const { return *work_; }
  /// Row or column of PETSc's matrix of an unknown, -1 where it is condensed.
  int petsc_index(int unknown) const { return petsc_index_[unknown]; }
  /// Computes the matrix without preparing solutions.
  void assemble(const LoadedStage& stage, std::span<const double> y);
  Mat matrix() const { return matrix_.get(); }

 private:
  void share_rows(const std::vector<int>& owner_of_cell);
  /// The same without condensed unknowns.
  bool solve_rows(std::span<double> right_hand_side);
  void make_matrix();
  void make_solver();
  BloodVolumes blood_volumes() const;

  const Problem& problem_;
  const Layout& layout_;
  const Ranks& ranks_;
  SolverChoice choice_;
  std::unique_ptr<CellWork> work_;
  std::vector<int> petsc_index_;       ///< by unknown
  bool condenses_ = false;             ///< on any rank
  std::vector<int> counts_, offsets_;  ///< rows by rank
  OwnedMatrix matrix_;
  OwnedSolver solver_;
  OwnedVector right_, solution_;
  std::size_t own_entries_ = 0;  ///< in the pattern of the cells
  std::vector<double> values_;
  /// For Krylov methods.
  std::unique_ptr<Blocks> blocks_;
  double entries_ = 0, assembly_seconds_ = 0;
  long iterations_ = 0, latest_iterations_ = 1, solutions_ = 0;
};

}  // namespace tunica::full3d
