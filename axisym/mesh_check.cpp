// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/mesh_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/coupled/gmsh_parts.hpp"
#include "core/error.hpp"

namespace tunica::axisym {

namespace {

[[noreturn]] void refuse(const std::string& label, const std::string& why) {
  throw InvalidInput(fmt::format("{}: {}", label, why));
}

/// The outline of a part as the boundaries that it passes, counter-clockwise.
std::vector<Boundary> outline(const Mesh& mesh, Part part, const std::string& label) {
  struct Step {
    int to;
    Boundary boundary;
  };
  std::unordered_map<int, Step> steps;
  int start = -1;
  for (const Edge& edge : mesh.edges) {
    if (mesh.cells[edge.cell].part != part) continue;
    const auto nodes = mesh.side_nodes(edge.cell, edge.side);
    if (!steps.emplace(nodes[0], Step{nodes[1], edge.boundary}).second)
      refuse(label, fmt::format("the {} touches itself with a corner at {}; open or close the gap there",
                                name(part), where(mesh.points[nodes[0]])));
    if (start < 0) start = nodes[0];
  }
  std::vector<Boundary> passed;
  std::size_t count = 0;
  for (int node = start; count == 0 || node != start; ++count) {
    const auto found = steps.find(node);
    if (found == steps.end())
      refuse(label,
             fmt::format("the outline of the {} ends at {}; close it", name(part), where(mesh.points[node])));
    const Step step = found->second;
    steps.erase(found);
    if (passed.empty() || passed.back() != step.boundary) passed.push_back(step.boundary);
    node = step.to;
  }
  if (!steps.empty()) {
    const int other = std::min_element(steps.begin(), steps.end(), [](const auto& a, const auto& b) {
                        return a.first < b.first;
                      })->first;
    refuse(label,
           fmt::format("the {} is not one piece without holes: a second outline passes {}; remesh it as one "
                       "piece whose cells share their nodes",
                       name(part), where(mesh.points[other])));
  }
  if (passed.size() > 1 && passed.front() == passed.back()) passed.pop_back();
  return passed;
}

std::string listed(const std::vector<Boundary>& boundaries) {
  std::vector<std::string_view> names;
  for (const Boundary each : boundaries) names.push_back(name(each));
  constexpr std::size_t most = 8;
  const bool more = names.size() > most;
  names.resize(std::min(names.size(), most));
  return fmt::format("{}{}", fmt::join(names, ", "), more ? ", ..." : "");
}

void check_order(const Mesh& mesh, Part part, const std::string& label) {
  using enum Boundary;
  std::vector<Boundary> expected = part == Part::blood
                                       ? std::vector<Boundary>{inlet, interface, outlet, axis}
                                       : std::vector<Boundary>{wall_inlet, outer, wall_outlet, interface};
  std::vector<Boundary> passed = outline(mesh, part, label);
  for (const Boundary each : expected)
    if (std::find(passed.begin(), passed.end(), each) == passed.end())
      refuse(label, fmt::format("the {} has no {}; its outline has to pass {}", name(part), name(each),
                                listed(expected)));
  std::rotate(passed.begin(), std::find(passed.begin(), passed.end(), expected.front()), passed.end());
  if (passed == expected) return;
  const std::vector<Boundary> turned = {expected[0], expected[3], expected[2], expected[1]};
  if (passed == turned)
    refuse(label, fmt::format("the {} lies above the {}; swap the two names, or turn the mesh round",
                              name(expected[0]), name(expected[2])));
  refuse(label,
         fmt::format("the outline of the {} passes {}; it has to pass {}, each once: name its sides so",
                     name(part), listed(passed), listed(expected)));
}

}  // namespace

void check_plane(const Mesh& mesh, Boundary boundary, const std::string& label) {
  double low = INFINITY, high = -INFINITY;
  for (const Edge& edge : mesh.edges) {
    if (edge.boundary != boundary) continue;
    for (const int node : mesh.side_nodes(edge.cell, edge.side)) {
      low = std::min(low, mesh.points[node][1]);
      high = std::max(high, mesh.points[node][1]);
    }
  }
  constexpr double even = 1e-6;  // of the radius: an outline drawn by hand is that straight
  if (high - low > even * inlet_radius(mesh))
    refuse(label,
           fmt::format("the {} is no plane z = const: it reaches from z = {:.6g} to {:.6g} cm; draw it "
                       "straight and normal to the axis",
                       name(boundary), low, high));
}

double inclination(const Mesh& mesh, Boundary boundary) {
  double squares = 0, area = 0;
  for (const Edge& edge : mesh.edges) {
    if (edge.boundary != boundary) continue;
    const auto nodes = mesh.side_nodes(edge.cell, edge.side);
    // From end to middle to end.
    for (const auto& [from, to] : {std::pair{nodes[0], nodes[2]}, {nodes[2], nodes[1]}}) {
      const std::array<double, 2>&a = mesh.points[from], &b = mesh.points[to];
      const double across = std::abs(b[0] - a[0]), ring = (a[0] + b[0]) * across;
      if (ring == 0) continue;
      squares += ring * std::pow((b[1] - a[1]) / across, 2);
      area += ring;
    }
  }
  return area > 0 ? std::sqrt(squares / area) : 0;
}

std::string where(const std::array<double, 2>& point) {
  return fmt::format("(r, z) = ({:.6g}, {:.6g}) cm", point[0], point[1]);
}

std::string cell_name(const Mesh& mesh, int cell, std::span<const long> tags) {
  return fmt::format("{} {}", mesh.shape == CellShape::triangle ? "triangle" : "quadrilateral",
                     tags.empty() ? cell : tags[cell]);
}

void check_cells(const Mesh& mesh, const std::string& label, std::span<const long> tags) {
  const auto rule = element::cell_rule(mesh.shape, element::Basis::quadratic);
  constexpr double rounding = 1e-9;  // of the mean
  for (int k = 0; k < static_cast<int>(mesh.cells.size()); ++k) {
    double area = 0, total = 0, lowest = INFINITY;
    std::array<double, 2> place{};
    const auto note = [&](const Image& at) {
      if (!(at.determinant() < lowest)) return;
      lowest = at.determinant();
      place = at.point;
    };
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const Image at = image(mesh, k, rule.points[q]);
      area += rule.weights[q] * at.determinant();
      total += rule.weights[q];
      note(at);
    }
    for (int n = 0; n < mesh.nodes_per_cell(); ++n) {
      const Image at = image(mesh, k, element::node_position(mesh.shape, n));
      // A corner between two sides in line is legitimate: there the determinant vanishes.
      if (at.determinant() < -rounding * std::abs(area / total)) note(at);
    }
    if (lowest > 0 && area > 0) continue;  // the latter fails where a determinant is no number
    refuse(label,
           fmt::format("{} is inverted: the determinant of its map is {:.3g} cm2 at {}; use smaller cells "
                       "there, straighter sides, or Mesh.HighOrderOptimize = 2",
                       cell_name(mesh, k, tags), lowest, where(place)));
  }
}

void check_outline(const Mesh& mesh, const std::string& label) {
  for (const Part part : {Part::blood, Part::wall})
    if (mesh.has(part)) check_order(mesh, part, label);
}

void check_layers(const Mesh& mesh, const std::string& label, std::span<const long> tags) {
  constexpr const char* remedy = coupled::layers_remedy;
  const int layers = mesh.layers();
  for (const Edge& edge : mesh.edges) {
    const Cell& cell = mesh.cells[edge.cell];
    if (cell.part == Part::blood) continue;
    const bool inner = edge.boundary == Boundary::interface, outer = edge.boundary == Boundary::outer;
    if ((inner && cell.layer != 0) || (outer && cell.layer != layers - 1))
      refuse(label, fmt::format("{} in layer {} of {} is at the {} surface of the wall, at {}; {}",
                                cell_name(mesh, edge.cell, tags), cell.layer + 1, layers,
                                inner ? "inner" : "outer", where(mesh.points[cell.nodes[0]]), remedy));
  }
  const std::vector<int> across = neighbours(mesh);
  for (int k = 0; k < static_cast<int>(mesh.cells.size()); ++k) {
    for (int side = 0; side < mesh.sides(); ++side) {
      const int other = across[k * mesh.sides() + side];
      if (other < 0 || mesh.cells[k].part == Part::blood || mesh.cells[other].part == Part::blood) continue;
      if (std::abs(mesh.cells[k].layer - mesh.cells[other].layer) > 1)
        refuse(label, fmt::format("{} in layer {} touches layer {} at {}; {}", cell_name(mesh, k, tags),
                                  mesh.cells[k].layer + 1, mesh.cells[other].layer + 1,
                                  where(mesh.points[mesh.side_nodes(k, side)[2]]), remedy));
    }
  }
}

}  // namespace tunica::axisym
