// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/wall_axes.hpp"

#include <cmath>

#include "full3d/harmonic.hpp"
#include "full3d/layout.hpp"

namespace tunica::full3d {

namespace {

double length(const Vector<double>& v) {
  return std::sqrt(dot(v, v));
}

constexpr Vector<double> unknown{NAN, NAN, NAN};

/// The vector made one of length 1; none of no length has no direction.
Vector<double> unit(Vector<double> v) {
  const double size = length(v);
  if (!(size > 0)) return unknown;
  for (double& component : v) component /= size;
  return v;
}

}  // namespace

Directions directions_of(const wall::MaterialAxes& axes) {
  return {cross(axes.circumferential, axes.axial), axes.circumferential, axes.axial};
}

Directions mean_directions(const Problem& problem, std::span<const Place> places, const Point& point) {
  Vector<double> axial{}, circumferential{};
  for (const Place& place : places) {
    const auto own = problem.directions(place.cell, place.local, point);
    for (int i = 0; i < 3; ++i) {
      if (!std::isnan(own.axial[i])) axial[i] += own.axial[i];
      if (!std::isnan(own.circumferential[i])) circumferential[i] += own.circumferential[i];
    }
  }
  axial = unit(axial);
  const double along = dot(circumferential, axial);
  for (int i = 0; i < 3; ++i) circumferential[i] -= along * axial[i];
  return directions_of({unit(circumferential), axial});
}

WallAxes::WallAxes(const Mesh& mesh) : mesh_(mesh) {
  const Basis basis = mesh.quadratic ? Basis::quadratic : Basis::linear;
  const auto wall = cells_of(mesh, Part::wall);
  const HeldBoundary ends[] = {{Boundary::wall_inlet, 0}, {Boundary::wall_outlet, 1}};
  along_ = harmonic(mesh, basis, wall, ends);
  const auto rule = element::solid::cell_rule(mesh.shape, basis);
  const HeldBoundary surfaces[] = {{Boundary::interface, 0}, {Boundary::outer, 1}};
  through_ = harmonic(mesh, basis, wall, surfaces, [&](int cell, std::size_t q) {
    return length(gradients(mesh, along_, along_, cell, rule.points[q])[0]);
  });
}

wall::MaterialAxes WallAxes::at(int cell, const element::solid::Local& local) const {
  const auto [along, through] = gradients(mesh_, along_, through_, cell, local);
  const Vector<double> axial = unit(along), around = cross(axial, through);
  constexpr double parallel = 1e-9;  // but for rounding
  return {length(around) > parallel * length(through) ? unit(around) : unknown, axial};
}

}  // namespace tunica::full3d
