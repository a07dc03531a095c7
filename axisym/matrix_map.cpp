// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/matrix_map.hpp"

#include <algorithm>
#include <iterator>

namespace tunica::axisym {

namespace {

/// Visits every block of a tangent with the rows and columns that it belongs to.
template <class Visit>
void visit_blocks(const Numbers& n, const BloodTangent& t, const Visit& visit) {
  constexpr bool by_velocity = true;
  for (int a = 0; a < 2; ++a) {
    for (int b = 0; b < 2; ++b) {
      visit(n.momentum[a], n.velocity[b], by_velocity, t.momentum_velocity[a][b]);
      visit(n.momentum[a], n.displacement[b], !by_velocity, t.momentum_displacement[a][b]);
    }
    visit(n.mesh[a], n.displacement[a], !by_velocity, t.mesh_displacement[a][a]);
    visit(n.momentum[a], n.pressure, !by_velocity, t.momentum_pressure[a][0]);
    visit(n.continuity, n.velocity[a], by_velocity, t.continuity_velocity[0][a]);
    visit(n.continuity, n.displacement[a], !by_velocity, t.continuity_displacement[0][a]);
  }
  visit(n.continuity, n.pressure, !by_velocity, t.continuity_pressure[0][0]);
}
template <class Visit>
void visit_blocks(const Numbers& n, const WallTangent& t, const Visit& visit) {
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b) visit(n.momentum[a], n.displacement[b], false, t.momentum[a][b]);
}
template <class Visit>
void visit_blocks(const Numbers& n, const SideTangent& t, const Visit& visit) {
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b) {
      visit(n.momentum[a], n.velocity[b], true, t.momentum_velocity[a][b]);
      visit(n.momentum[a], n.displacement[b], false, t.momentum_displacement[a][b]);
    }
}

/// Finds the places of a tangent's entries in the matrix, in the order in which scatter() visits them.
template <class Tangent, class Place>
std::vector<int> find_places(const Numbers& numbers, const Place& place) {
  std::vector<int> places;
  visit_blocks(numbers, Tangent{}, [&](const auto& rows, const auto& columns, bool, const auto& block) {
    constexpr int width = static_cast<int>(std::size(decltype(block.entry){}));
    for (int k = 0; k < width; ++k)
      for (int l = 0; l < width; ++l)
        places.push_back(rows[k] >= 0 && columns[l] >= 0 ? place(rows[k], columns[l]) : -1);
  });
  return places;
}

template <class Tangent>
void add(const Tangent& tangent, const Numbers& numbers, const std::vector<int>& places, double coefficient,
         double* values) {
  const int* place = places.data();
  visit_blocks(numbers, tangent, [&](const auto&, const auto&, bool by_velocity, const auto& block) {
    constexpr int width = static_cast<int>(std::size(decltype(block.entry){}));
    double factor[width];
    for (int l = 0; l < width; ++l) factor[l] = by_velocity && numbers.adheres[l] ? coefficient : 1.0;
    for (int k = 0; k < width; ++k)
      for (int l = 0; l < width; ++l, ++place)
        if (*place >= 0) values[*place] += factor[l] * block.entry[k][l];
  });
}

}  // namespace

void scatter(const BloodTangent& tangent, const Targets& targets, double coefficient, double* values) {
  add(tangent, targets.numbers, targets.places, coefficient, values);
}
void scatter(const WallTangent& tangent, const Targets& targets, double coefficient, double* values) {
  add(tangent, targets.numbers, targets.places, coefficient, values);
}
void scatter(const SideTangent& tangent, const Targets& targets, double coefficient, double* values) {
  add(tangent, targets.numbers, targets.places, coefficient, values);
}

Numbers::Numbers() {
  for (auto* list : {&momentum, &mesh, &velocity, &displacement})
    for (auto& component : *list) component.fill(-1);
  continuity.fill(-1);
  pressure.fill(-1);
  adheres.fill(false);
}

MatrixMap::MatrixMap(const Problem& problem, const Layout& layout, const Tables& tables)
    : problem_(problem), layout_(layout) {
  build_pattern(tables);
}

Numbers MatrixMap::cell_numbers(int index) const {
  const Mesh& mesh = problem_.mesh;
  const Element element = problem_.discretisation.element;
  const Cell& cell = mesh.cells[index];
  const Counts n = counts(mesh.shape, element);
  Numbers numbers;
  for (int c = 0; c < 2; ++c) {
    for (int k = 0; k < n.displacement; ++k) {
      const int node = cell.nodes[k];
      const int unknown = layout_.unknown(layout_.displacement(node, c));
      numbers.displacement[c][k] = unknown;
      if (layout_.on_wall(node))
        numbers.momentum[c][k] = unknown;
      else
        numbers.mesh[c][k] = unknown;
    }
    if (cell.part == Part::wall) continue;
    for (int k = 0; k < n.velocity; ++k) {
      const int node = velocity_node(mesh, element, cell, k);
      numbers.adheres[k] = layout_.on_wall(node);
      const std::size_t entry =
          numbers.adheres[k] ? layout_.displacement(node, c) : layout_.velocity(node, c);
      numbers.velocity[c][k] = layout_.unknown(entry);
      if (!numbers.adheres[k]) numbers.momentum[c][k] = layout_.unknown(entry);
    }
  }
  if (cell.part == Part::blood)
    for (int k = 0; k < n.pressure; ++k)
      numbers.continuity[k] = numbers.pressure[k] = layout_.unknown(layout_.pressure(cell.nodes[k]));
  return numbers;
}

Numbers MatrixMap::side_numbers(const SideTable& side) const {
  Numbers numbers;
  for (int k = 0; k < side.count; ++k) {
    const int node = side.nodes[k];
    numbers.adheres[k] = layout_.on_wall(node);
    for (int c = 0; c < 2; ++c) {
      numbers.displacement[c][k] = layout_.unknown(layout_.displacement(node, c));
      numbers.velocity[c][k] =
          numbers.adheres[k] ? numbers.displacement[c][k] : layout_.unknown(layout_.velocity(node, c));
      numbers.momentum[c][k] = numbers.velocity[c][k];
    }
  }
  return numbers;
}

std::optional<std::size_t> MatrixMap::pressure_entry(Boundary boundary) const {
  if (boundary == Boundary::inlet) return layout_.inlet_pressure;
  if (boundary == Boundary::outlet) return layout_.outlet_pressure;
  return std::nullopt;
}

std::vector<MatrixMap::ScalarRow> MatrixMap::scalar_rows(Boundary boundary) const {
  if (boundary == Boundary::inlet && layout_.inlet_pressure) return {{*layout_.inlet_pressure, -1.0}};
  if (boundary != Boundary::outlet || !layout_.outlet_pressure) return {};
  const OutletCondition& outlet = problem_.outlet;
  if (!layout_.windkessel_pressure) return {{*layout_.outlet_pressure, -outlet.resistance}};
  return {{*layout_.outlet_pressure, -outlet.proximal_resistance}, {*layout_.windkessel_pressure, -1.0}};
}

void MatrixMap::build_pattern(const Tables& tables) {
  for (const auto& table : tables.blood) blood_.push_back({cell_numbers(table.cell), {}});
  for (const auto& table : tables.wall) wall_.push_back({cell_numbers(table.cell), {}});
  for (const auto& table : tables.sides) sides_.push_back({side_numbers(table), {}});

  std::vector<std::vector<int>> columns(layout_.unknowns());
  const auto note = [&](int row, int column) {
    columns[column].push_back(row);
    return 0;
  };
  // A cell's blocks repeat the same pairs: sorting and thinning as columns grow bounds the memory.
  const auto thin = [&] {
    for (auto& rows : columns) {
      std::sort(rows.begin(), rows.end());
      rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    }
  };
  for (const auto& t : blood_) find_places<BloodTangent>(t.numbers, note);
  for (const auto& t : wall_) find_places<WallTangent>(t.numbers, note);
  for (const auto& t : sides_) find_places<SideTangent>(t.numbers, note);
  for (std::size_t s = 0; s < tables.sides.size(); ++s) {
    const Boundary boundary = tables.sides[s].boundary;
    const Numbers& n = sides_[s].numbers;
    for (int c = 0; c < 2; ++c)
      for (int k = 0; k < tables.sides[s].count; ++k) {
        if (const auto p = pressure_entry(boundary); p && n.momentum[c][k] >= 0)
          note(n.momentum[c][k], layout_.unknown(*p));
        for (const ScalarRow& row : scalar_rows(boundary))
          for (const int column : {n.velocity[c][k], n.displacement[c][k]})
            if (column >= 0) note(layout_.unknown(row.entry), column);
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

  const auto place = [this](int row, int column) {
    const int* begin = pattern_.innerIndexPtr() + pattern_.outerIndexPtr()[column];
    const int* end = pattern_.innerIndexPtr() + pattern_.outerIndexPtr()[column + 1];
    return static_cast<int>(std::lower_bound(begin, end, row) - pattern_.innerIndexPtr());
  };
  for (auto& t : blood_) t.places = find_places<BloodTangent>(t.numbers, place);
  for (auto& t : wall_) t.places = find_places<WallTangent>(t.numbers, place);
  for (auto& t : sides_) t.places = find_places<SideTangent>(t.numbers, place);
}

}  // namespace tunica::axisym
