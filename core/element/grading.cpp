// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/element/grading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numeric>

#include "core/error.hpp"

namespace tunica::element {

namespace {

/// [0, 1] onto itself with lengths of cells in geometric progression: x'(1)/x'(0) = exp(log_ratio).
double geometric(double s, double log_ratio) {
  return log_ratio == 0 ? s : std::expm1(log_ratio * s) / std::expm1(log_ratio);
}
double inverse_geometric(double x, double log_ratio) {
  return log_ratio == 0 ? x : std::log1p(x * std::expm1(log_ratio)) / log_ratio;
}

}  // namespace

std::vector<double> lines_along(double length, int cells, double grading) {
  const double steepness = std::acosh(std::sqrt(grading));
  std::vector<double> lines(cells + 1);
  // The upper half mirrors the lower one, whatever is rounded.
  for (int j = 0; j <= cells / 2; ++j) {
    const double x = 2.0 * j / cells - 1;
    const double stretched = steepness == 0 ? x : std::tanh(steepness * x) / std::tanh(steepness);
    lines[j] = 0.5 * length * (1 + stretched);
    lines[cells - j] = length - lines[j];
  }
  return lines;
}

double bending_layer(double radius, double thickness) {
  return 3 * std::sqrt(radius * thickness);
}

double bending_layer_grading(double radius, double thickness, double length) {
  // A quarter of the cells (x from -1 to -1/2) reaches to the layer's width: with t = tanh(d/2),
  // (1 - tanh(d/2)/tanh d)/2 = (1 - t^2)/4.
  const double layer = bending_layer(radius, thickness) / length;
  if (!(layer < 0.25)) return 1;
  const double steepness = 2 * std::atanh(std::sqrt(1 - 4 * layer));
  return std::pow(std::cosh(steepness), 2);
}

std::vector<double> shrinking_lines(int cells, double grading) {
  const double log_ratio = -std::log(grading);
  std::vector<double> lines;
  for (int i = 0; i < cells; ++i) lines.push_back(geometric(static_cast<double>(i) / cells, log_ratio));
  lines.push_back(1);
  return lines;
}

WallLines wall_lines(double radius, const std::vector<double>& layers, int cells, double grading) {
  const double thickness = std::accumulate(layers.begin(), layers.end(), 0.0);
  const double log_ratio = std::log(grading);
  // In the coordinate s cells are alike; each further cell goes to the layer where they are widest.
  std::vector<double> ends{0};
  double depth = 0;
  for (const double layer : layers)
    ends.push_back(inverse_geometric((depth += layer) / thickness, log_ratio));
  std::vector<int> counts(layers.size(), 1);
  const auto width = [&](std::size_t k) { return (ends[k + 1] - ends[k]) / counts[k]; };
  for (int shared = static_cast<int>(counts.size()); shared < cells; ++shared) {
    std::size_t widest = 0;
    for (std::size_t k = 1; k < counts.size(); ++k)
      // Layers that are as wide but for rounding count as equal: the inner one comes first.
      if (width(k) > width(widest) * (1 + 1e-9)) widest = k;
    ++counts[widest];
  }
  WallLines wall;
  double inner = radius;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    for (int i = 0; i < counts[k]; ++i) {
      const double s = ends[k] + i * width(k);
      wall.lines.push_back(i == 0 ? inner : radius + thickness * geometric(s, log_ratio));
      wall.layers.push_back(static_cast<int>(k));
    }
    inner += layers[k];
  }
  wall.lines.push_back(inner);
  return wall;
}

std::vector<double> with_midpoints(const std::vector<double>& lines) {
  std::vector<double> all{lines.front()};
  for (std::size_t i = 1; i < lines.size(); ++i) {
    all.push_back(0.5 * (lines[i - 1] + lines[i]));
    all.push_back(lines[i]);
  }
  return all;
}

void check_length(std::string_view key, double value) {
  if (!(value > 0) || !std::isfinite(value))
    throw InvalidInput(fmt::format("{} = {:g} cm; a mesh needs a positive length", key, value));
}

void check_cells(std::string_view key, int value) {
  if (value < 1) throw InvalidInput(fmt::format("{} = {}; a mesh needs at least 1", key, value));
}

void check_axial_cells(int value) {
  check_cells("mesh.axial_cells", value);
  if (value % 2 != 0)
    throw InvalidInput(fmt::format("mesh.axial_cells = {} is odd; take {}, so that mid-length is a cell line",
                                   value, value + 1.0));
}

void check_grading(std::string_view name, double value) {
  if (!(value >= 1 && value <= steepest_grading))
    throw InvalidInput(
        fmt::format("the mesh's {} = {:g}; allowed is 1 (uniform) to {:g}", name, value, steepest_grading));
}

void check_widths(const std::vector<double>& lines) {
  if (std::adjacent_find(lines.begin(), lines.end(), std::greater_equal<>()) != lines.end())
    throw InvalidInput("cells of the mesh would have no width; use fewer cells or a milder grading");
}

}  // namespace tunica::element
