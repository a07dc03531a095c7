// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "full3d/course.hpp"
#include "full3d/probes.hpp"
#include "full3d/wall_axes.hpp"

namespace tunica::full3d {

/// The wall at a point of a line across it.
struct WallState {
  double depth;  ///< in the unloaded wall, cm from the lumen
  int layer;
  WallStrain strain;
  Directions directions;
  wall::MaterialAxes axes() const { return {directions.circumferential, directions.axial}; }
};

/// Points of the wall along Course::across at an angle.
///
/// Strain is more accurate at the two Gauss-Legendre points across each quadratic cell than elsewhere
/// (Barlow, Int. J. Numer. Methods Eng. 10:243, 1976), and so is the wall pressure: where the line crosses
/// hexahedra from face to face, a parabola through the three of them in the same layer that are nearest
/// carries both to a point. In a vessel cut along a plane
/// of symmetry, points on it are read as the mean of both sides, and angles beyond it are those of the
/// mirror image.
class WallLine {
 public:
  /// So many points, from the inner surface to the outer one. A boundary of layers belongs to the inner one.
  WallLine(const Setup& setup, const Layout& layout, const Course& course, const Locator& locator,
           double angle, int points);

  double radius() const { return line_.radius; }  ///< of the inner surface from the centreline, cm
  std::size_t size() const { return spots_.size(); }
  int layer(std::size_t spot) const { return spots_[spot].layer; }
  std::vector<WallState> states(std::span<const double> y) const;

 private:
  /// A point of the line: its places among those of the probe.
  struct Reading {
    double depth;
    int layer;
    std::size_t first, count;
  };
  struct Spot : Reading {
    std::size_t first_sample;
    std::vector<double> weights;  ///< of samples; empty: the reading itself
    Directions directions;
  };
  Reading read(double depth, const Locator& locator, std::vector<Place>& places) const;
  void choose_samples(Spot& spot) const;
  WallStrain mean(const Reading& reading, const std::vector<WallStrain>& strains) const;
  WallStrain mirrored(WallStrain strain, int component) const;

  const Setup& setup_;
  double angle_;                  ///< within the part that is meshed
  bool turned_x_, turned_y_;      ///< the line is the mirror image of that at angle_
  bool on_x_plane_, on_y_plane_;  ///< it lies in a plane that the vessel is cut along
  Across line_;                   ///< at angle_
  std::vector<Reading> samples_;
  std::vector<Spot> spots_;
  std::unique_ptr<WallProbe> probe_;
};

}  // namespace tunica::full3d
