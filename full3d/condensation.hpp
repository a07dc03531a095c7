// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <span>
#include <vector>

#include "core/coupled/numbers.hpp"

namespace tunica::full3d {

/// Unknowns of a bubble, which couple with nothing outside of their cell: they are eliminated cell by cell,
/// from the derivative
///   S = A_oo - A_oi A_ii^-1 A_io    (o: other unknowns of the cell, i: the bubble's)
/// and from right-hand sides, and follow from the solution x_o as x_i = A_ii^-1 (b_i - A_io x_o).
template <class Frame, int Width>
class CondensedCell {
 public:
  using Numbers = coupled::Numbers<Frame, Width>;
  using Tangent = kernel::BloodTangent<Frame, Width>;

  /// `bubble` is the number of the velocity's shape function.
  CondensedCell(const Numbers& numbers, int bubble) : local_(numbers) {
    for (int c = 0; c < Frame::components; ++c) inner_.push_back(numbers.velocity[c][bubble]);
    const auto note = [&](int unknown) {
      if (unknown < 0 || std::find(inner_.begin(), inner_.end(), unknown) != inner_.end()) return;
      if (std::find(outer_.begin(), outer_.end(), unknown) == outer_.end()) outer_.push_back(unknown);
    };
    visit(local_, note);
    visit(local_, [&](int& unknown) { unknown = place(unknown); });
    mark_structure();
  }

  /// Visits the places of S, in the order of visit_entries: visit(row, column).
  template <class Visit>
  void visit_places(const Visit& visit) const {
    const int n = static_cast<int>(outer_.size());
    for (int r = 0; r < n; ++r)
      for (int c = 0; c < n; ++c)
        if (structure_(r, c)) visit(outer_[r], outer_[c]);
  }

  /// Takes the cell's derivative and visits the entries of S: visit(entry).
  template <class Visit>
  void take(const Tangent& tangent, double coefficient, const Visit& visit) {
    const auto n = static_cast<Eigen::Index>(outer_.size()), m = static_cast<Eigen::Index>(inner_.size());
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(n + m, n + m);
    coupled::visit_entries(tangent, local_, coefficient, [&](int row, int column, double entry) {
      if (row >= 0 && column >= 0) all(row, column) += entry;
    });
    inverse_ = all.bottomRightCorner(m, m).inverse();
    from_inner_ = all.topRightCorner(n, m) * inverse_;
    to_inner_ = inverse_ * all.bottomLeftCorner(m, n);
    all.topLeftCorner(n, n) -= from_inner_ * all.bottomLeftCorner(m, n);
    for (Eigen::Index r = 0; r < n; ++r)
      for (Eigen::Index c = 0; c < n; ++c)
        if (structure_(r, c)) visit(all(r, c));
  }

  /// Adds -A_oi A_ii^-1 b_i to `change`.
  void condense(std::span<const double> right, std::span<double> change) const {
    const Eigen::VectorXd moved = from_inner_ * gather(inner_, right);
    for (std::size_t k = 0; k < outer_.size(); ++k) change[outer_[k]] -= moved[static_cast<Eigen::Index>(k)];
  }
  /// Sets x_i.
  void recover(std::span<const double> right, std::span<double> solution) const {
    const Eigen::VectorXd found = inverse_ * gather(inner_, right) - to_inner_ * gather(outer_, solution);
    for (std::size_t k = 0; k < inner_.size(); ++k) solution[inner_[k]] = found[static_cast<Eigen::Index>(k)];
  }
  const std::vector<int>& inner() const { return inner_; }

 private:
  template <class Visit>
  static void visit(Numbers& numbers, const Visit& visit) {
    for (auto* list : {&numbers.displacement, &numbers.mesh, &numbers.velocity, &numbers.momentum})
      for (auto& component : *list)
        for (int& unknown : component) visit(unknown);
    for (auto* list : {&numbers.pressure, &numbers.continuity})
      for (int& unknown : *list) visit(unknown);
  }
  int place(int unknown) const {
    if (unknown < 0) return -1;
    const auto outer = std::find(outer_.begin(), outer_.end(), unknown);
    if (outer != outer_.end()) return static_cast<int>(outer - outer_.begin());
    const auto inner = std::find(inner_.begin(), inner_.end(), unknown);
    return static_cast<int>(outer_.size()) + static_cast<int>(inner - inner_.begin());
  }
  void mark_structure() {
    const auto n = static_cast<Eigen::Index>(outer_.size()), m = static_cast<Eigen::Index>(inner_.size());
    Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic> all;
    all.setZero(n + m, n + m);
    coupled::visit_places<Tangent>(local_, [&](int row, int column) {
      if (row >= 0 && column >= 0) all(row, column) = true;
    });
    structure_ = all.topLeftCorner(n, n);
    for (Eigen::Index r = 0; r < n; ++r)
      if (all.row(r).tail(m).any())
        for (Eigen::Index c = 0; c < n; ++c)
          if (all.col(c).tail(m).any()) structure_(r, c) = true;
  }
  static Eigen::VectorXd gather(const std::vector<int>& unknowns, std::span<const double> values) {
    Eigen::VectorXd gathered(static_cast<Eigen::Index>(unknowns.size()));
    for (std::size_t k = 0; k < unknowns.size(); ++k)
      gathered[static_cast<Eigen::Index>(k)] = values[unknowns[k]];
    return gathered;
  }

  Numbers local_;  ///< by place: outer unknowns, then inner ones
  std::vector<int> outer_, inner_;
  Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic> structure_;
  Eigen::MatrixXd inverse_, from_inner_, to_inner_;
};

}  // namespace tunica::full3d
