// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/measures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace tunica::full3d {

using element::solid::Basis;

double volume(const Mesh& mesh, Part part) {
  const auto rule = element::solid::cell_rule(mesh.shape, mesh.quadratic ? Basis::quadratic : Basis::linear);
  double sum = 0;
  for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell)
    if (mesh.cells[cell].part == part)
      for (std::size_t q = 0; q < rule.points.size(); ++q)
        sum += rule.weights[q] * image(mesh, cell, rule.points[q]).determinant();
  return sum;
}

Surface surface(const Mesh& mesh, Boundary boundary) {
  Surface surface;
  for (const Face& face : mesh.faces) {
    if (face.boundary != boundary) continue;
    if (boundary == Boundary::interface && mesh.cells[face.cell].part == Part::blood) continue;
    const auto rule =
        element::solid::face_rule(mesh.shape, mesh.quadratic ? Basis::quadratic : Basis::linear, face.face);
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const Image at = image(mesh, face.cell, rule.points[q]);
      Vector<double> along[2] = {};
      for (int s = 0; s < 2; ++s)
        for (int i = 0; i < 3; ++i)
          for (int c = 0; c < 3; ++c) along[s][i] += at.slope[i][c] * rule.directions[s][c];
      const Vector<double> oriented = cross(along[0], along[1]);
      const double area = rule.weights[q] * std::sqrt(dot(oriented, oriented));
      surface.area += area;
      for (int i = 0; i < 3; ++i) {
        surface.centre[i] += area * at.point[i];
        surface.normal[i] += rule.weights[q] * oriented[i];
      }
    }
  }
  for (double& x : surface.centre) x /= surface.area;
  const double size = std::sqrt(dot(surface.normal, surface.normal));
  surface.projected = size;
  for (double& n : surface.normal) n /= size;
  return surface;
}

double inclination(const Surface& surface) {
  return std::sqrt(std::max(0.0, 2 * (surface.area / surface.projected - 1)));
}

MeanTube mean_tube(const Mesh& mesh) {
  const double inner = surface(mesh, Boundary::interface).area, outer = surface(mesh, Boundary::outer).area;
  if (!(outer > inner))
    throw InvalidInput(
        fmt::format("mesh: the surface \"outer\" of {:.4g} cm2 is not larger than the inner one of {:.4g} "
                    "cm2; name the outer "
                    "surface of the wall \"outer\", and no other",
                    outer, inner));
  MeanTube tube{};
  tube.thickness = 2 * volume(mesh, Part::wall) / (inner + outer);
  tube.radius = tube.thickness * inner / (outer - inner);
  tube.length = inner / (2 * std::numbers::pi * tube.radius);
  return tube;
}

double inlet_radius(const Mesh& mesh) {
  return mesh.has(Part::blood) ? std::sqrt(surface(mesh, Boundary::inlet).area / std::numbers::pi)
                               : mean_tube(mesh).radius;
}

}  // namespace tunica::full3d
