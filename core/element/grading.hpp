// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>
#include <vector>

/// Cell lines of structured meshes of vessels, one direction at a time. Gradings compare lengths of cells;
/// 1 is uniform. A mesh of twice as many cells has the lines of the coarse one, and one between each two.
namespace tunica::element {

/// Ratio of the longest to the shortest cell in one direction that numbers still resolve.
inline constexpr double steepest_grading = 1e6;

/// z = L/2 (1 + tanh(d x)/tanh d) at equidistant x in [-1, 1], with cosh^2 d the grading, of cells at
/// mid-length to those at the ends (Vinokur, J. Comput. Phys. 50:215, 1983). `cells` is even; the upper half
/// mirrors the lower one.
std::vector<double> lines_along(double length, int cells, double grading);

/// Width of the boundary layer in which a clamped shell bends: 3 sqrt(R h), after which
/// exp(-1.22 z/sqrt(R h)) has fallen to 3 %.
double bending_layer(double radius, double thickness);

/// End grading that gives half of the axial cells to these two layers. 1 for a tube so short
/// that they cover half of it.
double bending_layer_grading(double radius, double thickness, double length);

/// From 0 to 1 with lengths of cells in geometric progression; the grading is of cells at 0 to those at 1.
std::vector<double> shrinking_lines(int cells, double grading);

/// Radial lines through a wall, and the layer that each cell belongs to.
struct WallLines {
  std::vector<double> lines;
  std::vector<int> layers;
};
/// Lengths of cells in geometric progression, graded from the outer surface to the inner one, but for lines
/// on the boundaries of the layers, so that a wall has at least as many cells as layers; cells are shared out
/// so that the widest one is as thin as can be.
WallLines wall_lines(double radius, const std::vector<double>& layers, int cells, double grading);

/// The lines with the middle of each two in between.
std::vector<double> with_midpoints(const std::vector<double>& lines);

/// Refusals (InvalidInput) of lengths in cm that are not positive and finite, counts below 1, odd numbers of
/// axial cells, gradings outside 1 to 10^6, and lines too close for numbers to tell apart.
void check_length(std::string_view key, double value);
void check_cells(std::string_view key, int value);
void check_axial_cells(int value);
void check_grading(std::string_view name, double value);
void check_widths(const std::vector<double>& lines);

}  // namespace tunica::element
