// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/mesh_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace tunica::full3d {

using element::solid::Basis;

DistortionMeter::DistortionMeter(const Mesh& mesh) : mesh_(mesh) {
  const Basis basis = mesh.quadratic ? Basis::quadratic : Basis::linear;
  auto points = element::solid::cell_rule(mesh.shape, basis).points;
  for (int k = 0; k < element::solid::shape_count(mesh.shape, Basis::linear); ++k)
    points.push_back(element::solid::node_position(mesh.shape, Basis::linear, k));
  for (const auto& point : points) shapes_.push_back(element::solid::shapes_at(mesh.shape, basis, point));
  for (int k = 0; k < element::solid::shape_count(mesh.shape, basis); ++k)
    places_.push_back(node_place(mesh.shape, basis, k));
}

Distortion DistortionMeter::of(int cell) const {
  Distortion worst{INFINITY, INFINITY};
  for (const auto& shapes : shapes_) {
    Image at;
    for (int k = 0; k < shapes.count; ++k) {
      const Point& x = mesh_.points[mesh_.cells[cell].nodes[places_[k]]];
      for (int i = 0; i < 3; ++i)
        for (int c = 0; c < 3; ++c) at.slope[i][c] += shapes.slope[k][c] * x[i];
    }
    double lengths = 1;
    for (int c = 0; c < 3; ++c) lengths *= std::hypot(at.slope[0][c], at.slope[1][c], at.slope[2][c]);
    const double determinant = at.determinant();
    worst.least_determinant = std::min(worst.least_determinant, determinant);
    worst.least_scaled = std::min(worst.least_scaled, lengths > 0 ? determinant / lengths : 0);
  }
  return worst;
}

void check_cells(const Mesh& mesh) {
  const DistortionMeter meter(mesh);
  for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell) {
    if (meter.of(cell).least_determinant > 0) continue;
    const Point& at = mesh.points[mesh.cells[cell].nodes[0]];
    throw InvalidInput(fmt::format(
        "a cell of the mesh's {} near ({:.4g}, {:.4g}, {:.4g}) cm is turned inside out; use more cells "
        "around and along the vessel",
        name(mesh.cells[cell].part), at[0], at[1], at[2]));
  }
}

}  // namespace tunica::full3d
