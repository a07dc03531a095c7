// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "axisym/wall_state.hpp"

namespace tunica::axisym {

/// The wall at a point of a line across it.
struct WallState {
  double radius;  ///< in the unloaded wall, cm
  int layer;
  WallStrain strain;
  wall::MaterialAxes axes;
};

/// Points of the wall along the radius at a height of the unloaded vessel.
///
/// Where the line crosses quadrilaterals from side to side or runs along sides of triangles, strain is a
/// whole order more accurate at the Gauss-Legendre points of each cell along it, two for quadratic and one
/// for linear displacements, than elsewhere (Barlow, Int. J. Numer. Methods Eng. 10:243, 1976); so is the
/// wall pressure. A parabola through the three of them in the same layer that are nearest carries both to a
/// point. Hoop strain needs no slope: it is d_r/r. Elsewhere the strain is the mean of the cells that meet at
/// the point.
class WallLine {
 public:
  /// Throws InvalidInput if the plane of that height does not cut the vessel, std::logic_error for radii
  /// outside the wall. A boundary of layers belongs to the inner one.
  WallLine(const WallReader& reader, double height, const std::vector<double>& radii);

  std::size_t size() const { return spots_.size(); }
  int layer(std::size_t spot) const { return spots_[spot].layer; }
  /// Cells that meet at a point, in its layer.
  const std::vector<Place>& places(std::size_t spot) const { return spots_[spot].places; }

  /// The wall at each of the radii.
  std::vector<WallState> states(std::span<const double> y) const;

 private:
  struct Sample {
    double radius;
    int layer;
    bool is_best;  ///< strain is more accurate there
    std::vector<Place> places;
  };
  struct Spot {
    double radius;
    int layer;
    std::vector<Place> places;
    std::size_t first;            ///< of the samples
    std::vector<double> weights;  ///< empty: mean over the places
    wall::MaterialAxes axes;
  };
  void choose_samples(Spot& spot) const;
  void note_cells(const std::vector<Place>& places);
  /// Mean over the places in those of cells_ at a state.
  WallStrain mean(const std::vector<Place>& places, const std::vector<WallCell>& cells) const;

  const WallReader& reader_;
  std::vector<Sample> samples_;
  std::vector<Spot> spots_;
  std::vector<int> cells_;  ///< that any of them are in, sorted: what each is at a state is found once
};

}  // namespace tunica::axisym
