// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/matrix_map.hpp"

#include <algorithm>
#include <type_traits>

#include "core/coupled/openings.hpp"

namespace tunica::axisym {

MatrixMap::MatrixMap(const Problem& problem, const Layout& layout, const Tables& tables)
    : problem_(problem), layout_(layout) {
  build_pattern(tables);
}

void MatrixMap::build_pattern(const Tables& tables) {
  const auto nodes = [&](int cell) {
    return CellNodes(problem_.mesh, problem_.discretisation.element, problem_.mesh.cells[cell]);
  };
  for (const auto& table : tables.blood)
    blood_.push_back({coupled::blood_numbers<Frame, cell_width>(layout_, nodes(table.cell).blood()), {}});
  for (const auto& table : tables.wall)
    wall_.push_back(
        {coupled::wall_numbers<Frame, cell_width>(layout_, nodes(table.cell).displacement()), {}});
  for (const auto& table : tables.sides)
    sides_.push_back({coupled::side_numbers<Frame, side_width>(layout_, nodes_of(table)), {}});

  std::vector<std::vector<int>> columns(layout_.unknowns());
  const auto note = [&](int row, int column) {
    if (row >= 0 && column >= 0) columns[column].push_back(row);
  };
  // A cell's blocks repeat the same pairs: sorting and thinning as columns grow bounds the memory.
  const auto thin = [&] {
    for (auto& rows : columns) {
      std::sort(rows.begin(), rows.end());
      rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    }
  };
  for (const auto& t : blood_) coupled::visit_places<BloodTangent>(t.numbers, note);
  for (const auto& t : wall_) coupled::visit_places<WallTangent>(t.numbers, note);
  for (const auto& t : sides_) coupled::visit_places<SideTangent>(t.numbers, note);
  for (std::size_t s = 0; s < tables.sides.size(); ++s) {
    const Boundary boundary = tables.sides[s].boundary;
    const SideNumbers& n = sides_[s].numbers;
    for (int c = 0; c < 2; ++c)
      for (int k = 0; k < tables.sides[s].count; ++k) {
        if (const auto p = coupled::pressure_entry(layout_, boundary))
          note(n.momentum[c][k], layout_.unknown(*p));
        for (const auto& row : coupled::scalar_rows(layout_, problem_, boundary))
          for (const int column : {n.velocity[c][k], n.displacement[c][k]})
            note(layout_.unknown(row.entry), column);
      }
  }
  for (std::size_t a = layout_.scalar_begin(); a < layout_.size(); ++a)
    for (std::size_t b = layout_.scalar_begin(); b < layout_.size(); ++b)
      note(layout_.unknown(a), layout_.unknown(b));
  thin();

  std::vector<int> sizes;
  for (const auto& rows : columns) sizes.push_back(static_cast<int>(rows.size()));
  pattern_.resize(layout_.unknowns(), layout_.unknowns());
  pattern_.reserve(sizes);
  for (std::size_t column = 0; column < columns.size(); ++column)
    for (const int row : columns[column]) pattern_.insert(row, static_cast<int>(column)) = 0;
  pattern_.makeCompressed();

  const auto find = [this](int row, int column) {
    if (row < 0 || column < 0) return -1;
    const int* begin = pattern_.innerIndexPtr() + pattern_.outerIndexPtr()[column];
    const int* end = pattern_.innerIndexPtr() + pattern_.outerIndexPtr()[column + 1];
    return static_cast<int>(std::lower_bound(begin, end, row) - pattern_.innerIndexPtr());
  };
  const auto place = [&]<class Tangent>(std::type_identity<Tangent>, auto& targets) {
    for (auto& t : targets)
      coupled::visit_places<Tangent>(t.numbers,
                                     [&](int row, int column) { t.places.push_back(find(row, column)); });
  };
  place(std::type_identity<BloodTangent>{}, blood_);
  place(std::type_identity<WallTangent>{}, wall_);
  place(std::type_identity<SideTangent>{}, sides_);
}

}  // namespace tunica::axisym
