// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCholesky>
#include <memory>
#include <span>

#include "axisym/matrix_map.hpp"
#include "core/coupled/equations.hpp"
#include "core/coupled/mesh_extension.hpp"
#include "core/threads.hpp"

namespace tunica::axisym {

using coupled::Direction;
using coupled::LeastJacobian;
using coupled::Stage;

/// The coupled equations of a problem.
class Assembler final : public coupled::Equations {
 public:
  /// The problem must outlive it. On meshes of a few hundred cells and more so many threads share the work;
  /// results do not depend on them.
  explicit Assembler(const Problem& problem, int threads = available_threads());
  Assembler(const Assembler&) = delete;
  Assembler& operator=(const Assembler&) = delete;

  const Problem& problem() const { return problem_; }
  const Layout& layout() const override { return layout_; }
  const Tables& tables() const { return tables_; }

  void complete(const Stage& stage, std::span<double> y) const override;
  bool residual(const Stage& stage, std::span<const double> y, std::span<double> residual) const override {
    return residual_of({}, stage, y, residual);
  }
  /// Which cells a residual is to have; sides and scalars are in all.
  struct Parts {
    bool blood = true, wall = true;
  };
  bool residual_of(const Parts& parts, const Stage& stage, std::span<const double> y,
                   std::span<double> residual) const;
  /// Derivatives of the residual along directions that move neither unknowns nor the wall (see
  /// coupled::KeyedEquations).
  void change(const Stage& stage, std::span<const double> y, std::span<const Direction> along,
              std::span<std::vector<double>> changes) const;
  void follow(double time, std::span<double> y) const override;
  const LeastJacobian& least_jacobian() const override { return least_; }
  /// By KLU.
  std::unique_ptr<coupled::TangentSolver> tangent_solver() const override;
  bool has_wall() const override { return problem_.mesh.has(Part::wall); }
  bool has_blood() const override { return problem_.mesh.has(Part::blood); }
  std::vector<double> volume_shares() const override;
  std::string place_of_node(int node) const override;
  std::string compression(const LeastJacobian& least) const override;

  /// A matrix with the pattern of the derivative.
  SparseMatrix pattern() const { return map_.pattern(); }
  /// Fills `matrix` (from pattern()) with the derivative at a complete state.
  void tangent(const Stage& stage, std::span<const double> y, SparseMatrix& matrix) const;

  /// Flow out through a boundary of the blood at a complete state.
  coupled::Throughflow flow(const Stage& stage, std::span<const double> y, Boundary boundary) const override;

 private:
  bool is_loaded(const SideTable& side) const;
  void add_sides(const Stage& stage, std::span<const double> y, std::span<double> residual) const;
  template <int Directions>
  void add_change(const Stage& stage, std::span<const double> y, const Direction* along,
                  std::vector<double>* changes) const;
  void add_loads(double time, std::span<double> residual) const;

  const Problem& problem_;
  int threads_;
  Layout layout_;
  Tables tables_;
  MatrixMap map_;
  struct Follower {
    explicit Follower(const Layout& layout) : extension(layout) {}
    coupled::MeshExtension extension;
    Eigen::SimplicialLDLT<SparseMatrix> factors;
  };
  mutable std::unique_ptr<Follower> follower_;  ///< made when the mesh first follows
  mutable LeastJacobian least_;
};

}  // namespace tunica::axisym
