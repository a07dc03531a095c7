// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "axisym/direct_solver.hpp"
#include "axisym/gather.hpp"
#include "axisym/layout.hpp"
#include "core/coupled/numbers.hpp"

namespace tunica::axisym {

using BloodTangent = kernel::BloodTangent<Frame, cell_width>;
using WallTangent = kernel::WallTangent<Frame, cell_width>;
using SideTangent = kernel::SideTangent<Frame, side_width>;

using CellNumbers = coupled::Numbers<Frame, cell_width>;
using SideNumbers = coupled::Numbers<Frame, side_width>;

/// A cell's or side's numbers, and the places in the matrix of its entries, -1 where there is none, in the
/// order of coupled::visit_entries.
template <class Numbers>
struct Targets {
  Numbers numbers;
  std::vector<int> places;
};

/// Where the equations of cells, sides and scalars stand in the matrix.
class MatrixMap {
 public:
  MatrixMap(const Problem& problem, const Layout& layout, const Tables& tables);

  const SparseMatrix& pattern() const { return pattern_; }
  /// In the order of the tables.
  const std::vector<Targets<CellNumbers>>& blood() const { return blood_; }
  const std::vector<Targets<CellNumbers>>& wall() const { return wall_; }
  const std::vector<Targets<SideNumbers>>& sides() const { return sides_; }

 private:
  void build_pattern(const Tables& tables);

  const Problem& problem_;
  const Layout& layout_;
  std::vector<Targets<CellNumbers>> blood_, wall_;
  std::vector<Targets<SideNumbers>> sides_;
  SparseMatrix pattern_;
};

/// Adds a tangent to the values of the matrix.
template <class Tangent, class Numbers>
void scatter(const Tangent& tangent, const Targets<Numbers>& targets, double coefficient, double* values) {
  const int* place = targets.places.data();
  coupled::visit_entries(tangent, targets.numbers, coefficient, [&](int, int, double entry) {
    if (*place >= 0) values[*place] += entry;
    ++place;
  });
}

}  // namespace tunica::axisym
