// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/coupled/mesh_extension.hpp"

namespace tunica::coupled {

void MeshExtension::note(int row, std::size_t column, double value) {
  // Cells repeat each other's places: thinning as the lists grow bounds the memory.
  constexpr std::size_t most = std::size_t{1} << 22;
  const auto rows = static_cast<Eigen::Index>(layout_.followers().size());
  if (among_.rows() == 0) {
    among_.resize(rows, rows);
    from_given_.resize(rows, static_cast<Eigen::Index>(layout_.velocity_begin()));
  }
  const int follower = layout_.follower(column);
  if (follower >= 0)
    among_entries_.emplace_back(row, follower, value);
  else
    given_entries_.emplace_back(row, static_cast<int>(column), value);
  if (among_entries_.size() >= most) gather(among_entries_, among_);
  if (given_entries_.size() >= most) gather(given_entries_, from_given_);
}

void MeshExtension::gather(Entries& entries, Matrix& matrix) {
  Matrix more(matrix.rows(), matrix.cols());
  more.setFromTriplets(entries.begin(), entries.end());
  matrix = matrix.nonZeros() == 0 ? more : Matrix(matrix + more);
  entries.clear();
}

void MeshExtension::finish() {
  gather(among_entries_, among_);
  gather(given_entries_, from_given_);
  among_entries_ = {};
  given_entries_ = {};
}

void MeshExtension::extend(std::span<double> loads, const Solve& solve, std::span<double> y) const {
  if (loads.empty()) return;
  Eigen::Map<Eigen::VectorXd> right(loads.data(), static_cast<Eigen::Index>(loads.size()));
  right -= from_given_ *
           Eigen::Map<const Eigen::VectorXd>(y.data(), static_cast<Eigen::Index>(layout_.velocity_begin()));
  solve(loads);
  for (std::size_t k = 0; k < loads.size(); ++k) y[layout_.followers()[k]] = loads[k];
}

}  // namespace tunica::coupled
