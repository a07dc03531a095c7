// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "axisym/wall_state.hpp"
#include "core/coupled/vessel_run.hpp"

namespace tunica::axisym {

/// The vessel's (r, z) half plane as pictures: x = r and z of the unloaded vessel, y the direction of the
/// circumference. Quadratic cells are shown as four, so that their sides bend.
///
/// Series "blood": displacement of the mesh, velocity, pressure. Series "wall": cell field "layer",
/// displacement; the Cauchy stress as von_mises, circumferential_stress, radial_stress, axial_stress and
/// shear_stress (sigma_rz), of the mean strain of those cells of a layer that meet at a point (points on
/// boundaries of layers are there once for each, so that jumps stay); recruitment, fiber_stretch and
/// fiber_direction (deformed, of unit length) of family 1, and with ".2" and so on of further families that
/// do not act alike, NaN in layers without such a family.
class Fields final : public coupled::Picturing {
 public:
  explicit Fields(const Assembler& assembler);

  /// Meshes and names for the parts that there are, blood before wall. No frames.
  std::vector<observables::FieldSeries> empty_series() const override;
  /// Appends a frame to each of the series that empty_series has made.
  void append(double time, std::span<const double> y,
              std::span<observables::FieldSeries> series) const override;

 private:
  /// A node of the mesh as a point of the picture.
  struct BloodPoint {
    int node;
    std::vector<int> corners;  ///< whose pressures' mean is that at the node
  };
  struct WallPoint {
    int node;
    int layer;
    std::vector<Place> places;  ///< in the layer's cells that meet there
  };
  /// A cell of the wall and its points, by its nodes.
  struct WallCellPoints {
    int cell;
    std::vector<int> points;
  };
  void add_blood();
  void add_wall();
  void show(int cell, std::span<const int> points, observables::FieldSeries& series) const;
  std::vector<std::vector<float>> blood_values(std::span<const double> y) const;
  std::vector<std::vector<float>> wall_values(std::span<const double> y) const;

  const Assembler& assembler_;
  WallReader reader_;
  int shown_nodes_;  ///< of a cell
  std::vector<BloodPoint> blood_points_;
  std::vector<WallPoint> wall_points_;
  std::vector<WallCellPoints> wall_cells_;
  std::vector<int> families_;  ///< that are shown, of any layer
  observables::FieldSeries blood_, wall_;
};

}  // namespace tunica::axisym
