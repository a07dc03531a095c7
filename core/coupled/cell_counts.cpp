// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/coupled/cell_counts.hpp"

#include <algorithm>
#include <cmath>

namespace tunica::coupled {

namespace {

/// Cells for a tolerance when an error of 1 % takes `at_one_percent`, and errors fall with the given order.
int cells(double at_one_percent, double order, double tolerance) {
  return static_cast<int>(std::ceil(at_one_percent * std::pow(0.01 / tolerance, 1 / order) - 1e-9));
}

double thickness_ratio(const Scene& scene) {
  return 1 + scene.number("geometry.thickness") / scene.number("geometry.radius");
}
constexpr double paper_thickness_ratio = 1 + 0.01 / 0.033;

/// A linear element of the same error is the square of a quadratic one's size. Across the artery the errors
/// of quadratic ones fall with the second order only: where fibres begin to be recruited the stress has a
/// kink, within a cell. Along it they fall faster.
struct Orders {
  double finer, across, through, along;
};
Orders orders(const Scene& scene) {
  if (scene.text("mesh.element") == "quadratic") return {1, 2.1, 2.6, 4.3};
  return {3, 2, 2, 2};
}

}  // namespace

CellCounts cell_counts(const Scene& scene) {
  const double tolerance = scene.number("accuracy.tolerance");
  const auto [finer, across, through, along] = orders(scene);
  CellCounts counts;
  // A thick wall is strained most at the lumen: more cells, in proportion to the logarithm of its radii.
  const double thick = std::max(1.0, std::log(thickness_ratio(scene)) / std::log(paper_thickness_ratio));
  counts.wall_cells = cells(thick * (finer == 1 ? 2.4 : 6), through, tolerance);
  counts.blood_cells = cells(2 * finer, across, tolerance);
  // Half of the cells lie in the layers where the clamped ends bend the wall, whose number does not depend on
  // the length; the rest follow the artery, a long one by cells of some fifty radii.
  const double half_length = 0.5 * scene.number("geometry.length") / scene.number("geometry.radius");
  counts.axial_cells = 2 * cells((7 + std::round(half_length / 50)) * finer, along, tolerance);
  counts.local_tolerance = 0.03 * tolerance;
  // Ten times less is not seen in any observable.
  counts.newton_tolerance = 0.1 * counts.local_tolerance;
  return counts;
}

void take_given(const Scene& scene, CellCounts& counts) {
  const auto take = [&](const char* key, int& count) {
    if (scene.has(key)) count = static_cast<int>(scene.integer(key));
  };
  take("mesh.wall_cells", counts.wall_cells);
  take("mesh.blood_cells", counts.blood_cells);
  take("mesh.axial_cells", counts.axial_cells);
  counts.wall_cells = std::max(counts.wall_cells, static_cast<int>(scene.count("wall.layers")));
}

int cells_as_along(const Scene& scene, double at_one_percent) {
  const Orders order = orders(scene);
  return cells(at_one_percent * order.finer, order.along, scene.number("accuracy.tolerance"));
}

double relative_thickness(const Scene& scene) {
  return std::max(1.0, thickness_ratio(scene) / paper_thickness_ratio);
}

}  // namespace tunica::coupled
