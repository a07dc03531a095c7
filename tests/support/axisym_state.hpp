// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "axisym/assembler.hpp"
#include "axisym/structured.hpp"
#include "tests/support/ring_cases.hpp"

namespace tunica::test_support {

/// A tube of R = 0.3, wall 0.12, L = 2 cm, coarse and graded: results on it depend on the mesh unless they
/// are exact. Six cells through the wall, so that P1..P4 are nodes.
inline axisym::TubeSpec small_tube(element::CellShape shape) {
  axisym::TubeSpec spec;
  spec.radius = 0.3;
  spec.layers = {0.12};
  spec.length = 2;
  spec.blood_cells = 3;
  spec.wall_cells = 6;
  spec.axial_cells = 4;
  spec.end_grading = 2;
  spec.interface_grading = 2;
  spec.shape = shape;
  return spec;
}

/// Bends the cells of a tube of length L (in place), the middle of it by nothing but a constriction.
inline void make_wavy(axisym::Mesh& mesh, double length) {
  for (auto& [r, z] : mesh.points) {
    r *= 1 - 0.2 * std::pow(std::sin(std::numbers::pi * z / length), 2);
    z += 0.5 * r * r * std::sin(2.3 * z);
  }
  if (mesh.shape != element::CellShape::triangle) return;
  // The centre belongs to the quadratic map: -1/9 of the corners and 4/9 of the middles.
  for (const axisym::Cell& cell : mesh.cells)
    for (int i = 0; i < 2; ++i) {
      double sum = 0;
      for (int k = 0; k < 3; ++k)
        sum += (4 * mesh.points[cell.nodes[3 + k]][i] - mesh.points[cell.nodes[k]][i]) / 9;
      mesh.points[cell.nodes[6]][i] = sum;
    }
}

inline std::vector<wall::Law<double>> laws_with(const std::vector<std::string>& overrides) {
  std::vector<wall::Law<double>> laws;
  for (const auto& layer : ring_with(overrides).layers) laws.push_back(layer.law);
  return laws;
}

inline axisym::Problem vessel(axisym::Mesh mesh, axisym::Element element,
                              const std::vector<std::string>& overrides) {
  axisym::Problem problem;
  problem.mesh = std::move(mesh);
  problem.discretisation.element = element;
  problem.laws = laws_with(overrides);
  problem.wall_density = 1.2;
  return problem;
}

/// A state given by functions of the place (r, z), at its nodes.
struct StateFunctions {
  std::function<axisym::Point(const axisym::Point&)> displacement, velocity;  ///< (r, z) components
  std::function<double(const axisym::Point&)> pressure;
};

inline std::vector<double> state_of(const axisym::Assembler& assembler, const StateFunctions& functions) {
  const axisym::Layout& layout = assembler.layout();
  const auto& points = assembler.problem().mesh.points;
  std::vector<double> y(layout.size(), 0.0);
  for (int node = 0; node < static_cast<int>(points.size()); ++node) {
    for (int c = 0; c < 2; ++c) {
      if (functions.displacement && layout.has_displacement(node))
        y[layout.displacement(node, c)] = functions.displacement(points[node])[c];
      // The bubble is a coefficient of its own: none.
      if (functions.velocity && layout.has_displacement(node))
        y[layout.velocity(node, c)] = functions.velocity(points[node])[c];
    }
    if (functions.pressure && layout.has_pressure(node))
      y[layout.pressure(node)] = functions.pressure(points[node]);
  }
  return y;
}

}  // namespace tunica::test_support
