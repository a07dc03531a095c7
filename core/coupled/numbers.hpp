// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <iterator>

#include "core/coupled/gather.hpp"

/// Which unknowns the shape functions of cells and sides belong to, and where the blocks of their tangents
/// stand in the matrix of all.
namespace tunica::coupled {

/// Unknowns of a cell's or side's test and trial functions, -1 where there is none, [component][function].
template <class Frame, int Width>
struct Numbers {
  static constexpr int n = Frame::components;
  std::array<std::array<int, Width>, n> momentum, mesh, velocity, displacement;
  std::array<std::array<double, Width>, n> share, lean;  ///< of displacements (Layout::column)
  std::array<int, Width> continuity, pressure;
  std::array<bool, Width> adheres;  ///< the velocity is the rate of the displacement
  bool mesh_couples = false;        ///< Layout::mesh_couples

  Numbers() {
    for (auto* list : {&momentum, &mesh, &velocity, &displacement})
      for (auto& component : *list) component.fill(-1);
    for (auto& component : share) component.fill(1.0);
    for (auto& component : lean) component.fill(0.0);
    continuity.fill(-1);
    pressure.fill(-1);
    adheres.fill(false);
  }
};

namespace detail {

template <class Frame, int Width>
void number_displacement(const Layout& layout, std::span<const int> nodes, Numbers<Frame, Width>& numbers) {
  for (int c = 0; c < Frame::components; ++c)
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const std::size_t entry = layout.displacement(nodes[k], c);
      const int unknown = layout.unknown(entry);
      const Layout::Column column = layout.column(entry);
      numbers.displacement[c][k] = column.unknown;
      numbers.share[c][k] = column.share;
      numbers.lean[c][k] = column.lean;
      (layout.on_wall(nodes[k]) ? numbers.momentum : numbers.mesh)[c][k] = unknown;
    }
}

}  // namespace detail

template <class Frame, int Width>
Numbers<Frame, Width> wall_numbers(const Layout& layout, std::span<const int> cell) {
  Numbers<Frame, Width> numbers;
  detail::number_displacement(layout, cell, numbers);
  return numbers;
}

template <class Frame, int Width>
Numbers<Frame, Width> blood_numbers(const Layout& layout, const BloodCellNodes& cell) {
  Numbers<Frame, Width> numbers;
  detail::number_displacement(layout, cell.displacement, numbers);
  numbers.mesh_couples = layout.mesh_couples();
  for (std::size_t k = 0; k < cell.velocity.size(); ++k) {
    const int node = cell.velocity[k];
    numbers.adheres[k] = layout.on_wall(node);
    for (int c = 0; c < Frame::components; ++c) {
      const std::size_t entry = numbers.adheres[k] ? layout.displacement(node, c) : layout.velocity(node, c);
      numbers.velocity[c][k] = layout.unknown(entry);
      if (!numbers.adheres[k]) numbers.momentum[c][k] = numbers.velocity[c][k];
    }
  }
  for (std::size_t k = 0; k < cell.pressure.size(); ++k)
    numbers.continuity[k] = numbers.pressure[k] = layout.unknown(layout.pressure(cell.pressure[k]));
  return numbers;
}

/// Some displacement is among the unknowns.
template <class Frame, int Width>
bool has_displacement(const Numbers<Frame, Width>& numbers) {
  return std::any_of(numbers.displacement.begin(), numbers.displacement.end(), [](const auto& component) {
    return std::any_of(component.begin(), component.end(), [](int unknown) { return unknown >= 0; });
  });
}

template <class Frame, int Width>
Numbers<Frame, Width> side_numbers(const Layout& layout, std::span<const int> side) {
  Numbers<Frame, Width> numbers;
  for (std::size_t k = 0; k < side.size(); ++k) {
    const int node = side[k];
    numbers.adheres[k] = layout.on_wall(node);
    for (int c = 0; c < Frame::components; ++c) {
      const Layout::Column column = layout.column(layout.displacement(node, c));
      numbers.displacement[c][k] = column.unknown;
      numbers.share[c][k] = column.share;
      numbers.lean[c][k] = column.lean;
      numbers.velocity[c][k] =
          numbers.adheres[k] ? numbers.displacement[c][k] : layout.unknown(layout.velocity(node, c));
      numbers.momentum[c][k] = numbers.velocity[c][k];
    }
  }
  return numbers;
}

namespace detail {

/// Of the columns of one component and of the first, by displacements.
template <std::size_t Width>
void share_values(const std::array<double, Width>& shares, const std::array<double, Width>& leans,
                  double (&values)[Width], double (*first)[Width]) {
  for (std::size_t l = 0; l < Width; ++l) {
    if (first) (*first)[l] += leans[l] * values[l];
    values[l] *= shares[l];
  }
}

template <class Frame, int Width>
void share_blocks(const Numbers<Frame, Width>& n, auto& blocks) {
  for (int b = 0; b < Frame::components; ++b)
    for (int k = 0; k < Width; ++k)
      share_values(n.share[b], n.lean[b], blocks[b].entry[k], b > 0 ? &blocks[0].entry[k] : nullptr);
}

}  // namespace detail

/// Makes derivatives by displacements those by the unknowns that these are shares of.
template <class Frame, int Width>
void share_columns(const Numbers<Frame, Width>& n, kernel::BloodTangent<Frame, Width>& t) {
  for (int a = 0; a < Frame::components; ++a) detail::share_blocks(n, t.momentum_displacement[a]);
  detail::share_blocks(n, t.continuity_displacement[0]);
}
template <class Frame, int Width>
void share_columns(const Numbers<Frame, Width>& n, kernel::SideTangent<Frame, Width>& t) {
  for (int a = 0; a < Frame::components; ++a) detail::share_blocks(n, t.momentum_displacement[a]);
  auto& flow = t.flow_displacement.value;
  for (int b = 0; b < Frame::components; ++b)
    detail::share_values(n.share[b], n.lean[b], flow[b], b > 0 ? &flow[0] : nullptr);
}

/// Visits every block of a tangent: visit(rows, columns, of a velocity, block).
template <class Frame, int Width, class Visit>
void visit_blocks(const Numbers<Frame, Width>& n, const kernel::BloodTangent<Frame, Width>& t,
                  const Visit& visit) {
  for (int a = 0; a < Frame::components; ++a) {
    for (int b = 0; b < Frame::components; ++b) {
      visit(n.momentum[a], n.velocity[b], true, t.momentum_velocity[a][b]);
      visit(n.momentum[a], n.displacement[b], false, t.momentum_displacement[a][b]);
      if (a == b || n.mesh_couples) visit(n.mesh[a], n.displacement[b], false, t.mesh_displacement[a][b]);
    }
    visit(n.momentum[a], n.pressure, false, t.momentum_pressure[a][0]);
    visit(n.continuity, n.velocity[a], true, t.continuity_velocity[0][a]);
    visit(n.continuity, n.displacement[a], false, t.continuity_displacement[0][a]);
  }
  visit(n.continuity, n.pressure, false, t.continuity_pressure[0][0]);
}
template <class Frame, int Width, class Visit>
void visit_blocks(const Numbers<Frame, Width>& n, const kernel::WallTangent<Frame, Width>& t,
                  const Visit& visit) {
  for (int a = 0; a < Frame::components; ++a)
    for (int b = 0; b < Frame::components; ++b)
      visit(n.momentum[a], n.displacement[b], false, t.momentum[a][b]);
}
template <class Frame, int Width, class Visit>
void visit_blocks(const Numbers<Frame, Width>& n, const kernel::SideTangent<Frame, Width>& t,
                  const Visit& visit) {
  for (int a = 0; a < Frame::components; ++a)
    for (int b = 0; b < Frame::components; ++b) {
      visit(n.momentum[a], n.velocity[b], true, t.momentum_velocity[a][b]);
      visit(n.momentum[a], n.displacement[b], false, t.momentum_displacement[a][b]);
    }
}

/// Visits every pair of a row and a column that a tangent has, in the order of visit_entries:
/// visit(row, column), -1 where there is none.
template <class Tangent, class Frame, int Width, class Visit>
void visit_places(const Numbers<Frame, Width>& numbers, const Visit& visit) {
  static const Tangent none{};
  visit_blocks(numbers, none, [&](const auto& rows, const auto& columns, bool, const auto&) {
    for (int k = 0; k < Width; ++k)
      for (int l = 0; l < Width; ++l) visit(rows[k], columns[l]);
  });
}

/// Visits the entries of a tangent: visit(row, column, entry). The columns of a velocity that is the rate of
/// a displacement are those of the displacement, times `coefficient` = d(rate)/d(displacement).
template <class Tangent, class Frame, int Width, class Visit>
void visit_entries(const Tangent& tangent, const Numbers<Frame, Width>& numbers, double coefficient,
                   const Visit& visit) {
  visit_blocks(numbers, tangent,
               [&](const auto& rows, const auto& columns, bool by_velocity, const auto& block) {
                 double factor[Width];
                 for (int l = 0; l < Width; ++l)
                   factor[l] = by_velocity && numbers.adheres[l] ? coefficient : 1.0;
                 for (int k = 0; k < Width; ++k)
                   for (int l = 0; l < Width; ++l) visit(rows[k], columns[l], factor[l] * block.entry[k][l]);
               });
}

/// residual += nodal values of a test field, [component][function] of both.
template <class Frame, int Width, class Rows>
void add_rows(const kernel::NodalVector<Frame, Width>& nodal, const Rows& rows, std::span<double> residual) {
  for (int c = 0; c < Frame::components; ++c)
    for (int k = 0; k < Width; ++k)
      if (rows[c][k] >= 0) residual[rows[c][k]] += nodal.value[c][k];
}

}  // namespace tunica::coupled
