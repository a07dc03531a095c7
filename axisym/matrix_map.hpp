// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "axisym/direct_solver.hpp"
#include "axisym/layout.hpp"
#include "axisym/tables.hpp"

namespace tunica::axisym {

using BloodTangent = kernel::BloodTangent<Frame, cell_width>;
using WallTangent = kernel::WallTangent<Frame, cell_width>;
using SideTangent = kernel::SideTangent<Frame, side_width>;

/// Unknowns of a cell's or side's test and trial functions, -1 where there is none, [component][function].
struct Numbers {
  std::array<std::array<int, cell_width>, 2> momentum, mesh, velocity, displacement;
  std::array<int, cell_width> continuity, pressure;
  std::array<bool, cell_width> adheres;  ///< the velocity is the rate of the displacement

  Numbers();
};

/// A cell's or side's numbers, and the places in the matrix of its entries in the order in which scatter()
/// visits them.
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
  const std::vector<Targets>& blood() const { return blood_; }
  const std::vector<Targets>& wall() const { return wall_; }
  const std::vector<Targets>& sides() const { return sides_; }

  /// Entry of y that holds the pressure on a boundary, none when there is no such unknown.
  std::optional<std::size_t> pressure_entry(Boundary boundary) const;
  /// Scalar equations that the flow out through a boundary enters.
  struct ScalarRow {
    std::size_t entry;  ///< of y
    double factor;      ///< on the flow out
  };
  std::vector<ScalarRow> scalar_rows(Boundary boundary) const;

 private:
  Numbers cell_numbers(int cell) const;
  Numbers side_numbers(const SideTable& side) const;
  void build_pattern(const Tables& tables);

  const Problem& problem_;
  const Layout& layout_;
  std::vector<Targets> blood_, wall_, sides_;
  SparseMatrix pattern_;
};

/// Adds a tangent to the matrix; the columns of a velocity that is the rate of a displacement are those of
/// the displacement, times d(rate)/d(displacement).
void scatter(const BloodTangent& tangent, const Targets& targets, double coefficient, double* values);
void scatter(const WallTangent& tangent, const Targets& targets, double coefficient, double* values);
void scatter(const SideTangent& tangent, const Targets& targets, double coefficient, double* values);

}  // namespace tunica::axisym
