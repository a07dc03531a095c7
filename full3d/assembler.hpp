// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "core/coupled/equations.hpp"
#include "full3d/mesh_follower.hpp"
#include "full3d/share.hpp"
#include "full3d/tangent_stability.hpp"

namespace tunica::full3d {

/// Tells the other ranks what the leader is about to do with a problem that they share.
class Announcer {
 public:
  virtual ~Announcer() = default;
  virtual void residual(const LoadedStage& stage, std::span<const double> y) = 0;
  virtual void factorise(const LoadedStage& stage, std::span<const double> y) = 0;
  virtual void solve() = 0;
  virtual void least_mode(const LoadedStage& stage, std::span<const double> y) = 0;
};

/// The coupled equations of a problem, on the leader: it computes its own share and has the other ranks
/// compute theirs.
class Assembler final : public coupled::Equations {
 public:
  /// The problem must outlive it. Without an announcer there must be one rank.
  Assembler(const Problem& problem, const Ranks& ranks, SolverChoice choice = {},
            std::unique_ptr<Announcer> announcer = nullptr);

  const Problem& problem() const { return problem_; }
  const Layout& layout() const override { return layout_; }
  void complete(const coupled::Stage& stage, std::span<double> y) const override;
  bool residual(const coupled::Stage& stage, std::span<const double> y,
                std::span<double> residual) const override;
  void follow(double time, std::span<double> y) const override;
  const LeastJacobian& least_jacobian() const override { return least_; }
  /// By KSP of PETSc. One at a time has factors.
  std::unique_ptr<coupled::TangentSolver> tangent_solver() const override;
  bool has_wall() const override { return problem_.mesh.has(Part::wall); }
  bool has_blood() const override { return problem_.mesh.has(Part::blood); }
  std::vector<double> volume_shares() const override;
  std::string place_of_node(int node) const override;
  std::string compression(const LeastJacobian& least) const override;

  /// Of a wall alone at a complete static state. Throws SolverFailure when a pivot vanishes.
  LeastMode least_mode(double time, std::span<const double> y) const;
  /// Flow out through a boundary of the whole vessel's blood at a complete state.
  coupled::Throughflow flow(const coupled::Stage& stage, std::span<const double> y,
                            Boundary boundary) const override;
  /// Iterations of Krylov methods so far.
  long krylov_iterations() const { return share_.iterations(); }
  /// All cells, on this rank.
  const CellWork& all_cells() const { return *all_; }
  Share& share() const { return share_; }
  LoadedStage loaded(const coupled::Stage& stage, std::span<const double> y) const;

 private:
  friend class SharedTangent;
  const Problem& problem_;
  const Ranks& ranks_;
  Layout layout_;
  mutable Share share_;
  std::unique_ptr<Announcer> announcer_;
  std::unique_ptr<CellWork> all_;
  mutable std::unique_ptr<MeshFollower> follower_;  ///< made when the mesh first follows
  mutable LeastJacobian least_;
  mutable const void* owner_of_factors_ = nullptr;
};

}  // namespace tunica::full3d
