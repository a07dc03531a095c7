// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/coupled/cell_counts.hpp"

#include <algorithm>
#include <cmath>

#include "core/coupled/waves.hpp"
#include "core/element/grading.hpp"
#include "core/error.hpp"
#include "core/inlet.hpp"
#include "core/radial/from_scene.hpp"

namespace tunica::coupled {

namespace {

/// Cells for a tolerance when an error of 1 % takes `at_one_percent`, and errors fall with the given order.
int cells(double at_one_percent, double order, double tolerance) {
  return static_cast<int>(std::ceil(at_one_percent * std::pow(0.01 / tolerance, 1 / order) - 1e-9));
}

/// Quadratic cells in a wave length for an error of 1 % of the pressure, which is linear in them, and the
/// order at which it falls: those of pulses of 1 and 2 ms that run to and fro in the paper's artery.
constexpr double cells_in_a_wave = 18, wave_order = 2;
/// Along very long arteries: more are for those who ask for them.
constexpr int most_cells_for_waves = 1000;

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

/// Half of the range of pressures in the lumen, as far as it is known beforehand.
double middle_pressure(const Scene& scene, const Inlet& inlet) {
  constexpr int samples = 64;
  double least = inlet.shape->at(0), greatest = least;
  for (int k = 1; k < samples; ++k) {
    const double value = inlet.shape->at(inlet.period * k / samples);
    least = std::min(least, value);
    greatest = std::max(greatest, value);
  }
  const double scale = inlet.scale_key.empty() ? 1.0 : scene.number(inlet.scale_key);
  const double middle = 0.5 * scale * (least + greatest);
  if (inlet.is_pressure) return middle;
  double resistance = scene.number("outlet.resistance");
  if (scene.has("outlet.proximal_resistance")) resistance += scene.number("outlet.proximal_resistance");
  return scene.number("outlet.pressure") + resistance * middle;
}

/// Cells along a meshed artery, at least `cells`, that are short enough for the waves in it. None are shorter
/// than those in the layers where clamped ends bend the wall, even if waves have jumps: the wall's bending
/// lets none pass that are much shorter than these.
int cells_for_waves(const Scene& scene, int cells) {
  const double grading = end_grading(scene), length = scene.number("geometry.length");
  if (scene.text("time.mode") == "static" || grading > element::steepest_grading) return cells;
  const Inlet inlet = inlet_from_scene(scene);
  double longest = 0;
  try {
    const double speed = wave_speed(*radial::ring_model(scene, {}), middle_pressure(scene, inlet),
                                    scene.number("blood.density"));
    longest = longest_cell(spectrum(inlet, scene.text("time.start") == "rest"), speed,
                           {cells_in_a_wave * orders(scene).finer, 0.01, wave_order},
                           scene.number("accuracy.tolerance"));
  } catch (const SolverFailure&) {
    // A wall that does not bear the pressure is the solver's to report.
    return cells;
  }
  const double in_layers =
      element::bending_layer(scene.number("geometry.radius"), scene.number("geometry.thickness")) /
      (0.25 * cells);
  longest = std::max(longest, in_layers);
  for (; cells < most_cells_for_waves; cells += 2) {
    const auto lines = element::lines_along(length, cells, grading);
    if (lines[cells / 2] - lines[cells / 2 - 1] <= longest) break;
  }
  return cells;
}

}  // namespace

double end_grading(const Scene& scene) {
  if (scene.text("geometry.ends") != "clamped") return 1;
  // Linear elements have other errors to lose first.
  const bool resolve_corners = scene.text("mesh.element") == "quadratic";
  return (resolve_corners ? corner_grading : 1) *
         element::bending_layer_grading(scene.number("geometry.radius"), scene.number("geometry.thickness"),
                                        scene.number("geometry.length"));
}

std::vector<std::vector<int>> coarser_counts(const std::vector<CellDirection>& directions) {
  double ratio = 1;
  for (const auto& [finest, least, multiple] : directions)
    ratio = std::max(ratio, static_cast<double>(finest) / least);
  constexpr double rounding = 1e-9;
  const int levels = static_cast<int>(std::ceil(std::log2(ratio) - rounding));
  std::vector<std::vector<int>> meshes(levels);
  for (int k = 0; k < levels; ++k)
    for (const auto& [finest, least, multiple] : directions) {
      const double whole = std::max(1.0, static_cast<double>(finest) / least);
      const double wanted = least * std::pow(whole, static_cast<double>(k) / levels) / multiple;
      meshes[k].push_back(std::min(finest, multiple * static_cast<int>(std::ceil(wanted - rounding))));
    }
  return meshes;
}

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
  const int for_ends = 2 * cells((7 + std::round(half_length / 50)) * finer, along, tolerance);
  const bool is_given = scene.text("geometry.kind") == "mesh" || scene.has("mesh.axial_cells");
  counts.axial_cells = is_given ? for_ends : cells_for_waves(scene, for_ends);
  counts.local_tolerance = 0.03 * tolerance;
  // The errors of waves that run to and fro add up.
  if (counts.axial_cells > for_ends) counts.local_tolerance *= 0.3;
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
