// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "full3d/course.hpp"
#include "full3d/level_set.hpp"

namespace tunica::full3d {

/// That of a mesh from a file. Sections are surfaces of constant phi,
///   div grad phi = 0,  phi = 0 on the inlet and wall_inlet,  phi = 1 on the outlet and wall_outlet,
///   d(phi)/dn = 0 on the rest,
/// in blood and wall together; the centreline goes through the centres of the lumen's sections (of the wall's
/// without blood). Angle 0 is that of the coordinate x (y where the inlet's normal is nearer to x) at the
/// inlet, carried along the centreline without twist: in a torus that begins as o_grid_vessel's does, the
/// outside of the bend.
class GivenCourse final : public Course {
 public:
  GivenCourse(const Setup& setup, const Locator& locator);
  /// Throws InvalidInput where no wall is met at that angle.
  Across across(double angle) const override;
  std::vector<double> cell_lines(const Across& across) const override;
  std::vector<AlongPoint> along() const override;
  std::vector<int> further_angles() const override { return {90, 180, 270}; }
  std::function<double(std::span<const double>)> section_pressure(const Layout& layout) const override;

  double length() const { return stations_.back().s; }  ///< of the centreline, cm

 private:
  struct Station {
    double level;  ///< of phi
    Point centre;
    double reach;  ///< of the section from its centre, cm
    double s = 0;
    Vector<double> tangent{};  ///< mean normal of the section
    Vector<double> x_axis{};
  };
  Boundary end_of_vessel(bool first) const;
  /// Section at a level within the vessel.
  Station section(double level) const;
  /// Length of the centreline between stations.
  static double arc(const Station& from, const Station& to);
  void carry_x_axis();
  Station middle() const;
  /// Distance of the wall from a station's centre along a direction.
  std::optional<double> distance_to_wall(const Station& station, const Vector<double>& direction) const;
  /// Direction across the wall at a place of it: of its cell, of cells that meet there, or the other one
  /// where the mesh leaves them open.
  Vector<double> radial_at(const Place& place, const Point& point, const Vector<double>& otherwise) const;
  /// Ends of the faces' depths that the line crosses one cell at; nothing where it enters or leaves the cell
  /// through a side.
  std::optional<double> end_of_cell(const Across& across, double depth) const;

  const Setup& setup_;
  const Mesh& mesh_;
  const Locator& locator_;
  Part part_;  ///< whose sections' centres are on the centreline
  double thickness_;
  std::vector<double> phi_;  ///< by node
  std::vector<Station> stations_;
  Station middle_;
};

}  // namespace tunica::full3d
