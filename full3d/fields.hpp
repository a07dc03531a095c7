// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/coupled/vessel_run.hpp"
#include "full3d/assembler.hpp"
#include "full3d/probes.hpp"
#include "full3d/setup.hpp"

namespace tunica::full3d {

/// The unloaded vessel as pictures. Quadratic cells are shown as eight, so that their sides bend.
///
/// Series "blood": displacement of the mesh, velocity, pressure. Series "wall": cell field "layer",
/// displacement; the Cauchy stress as von_mises, circumferential_stress, radial_stress, axial_stress, of the
/// mean strain of those cells of a layer that meet at a point (points on boundaries of layers are there once
/// for each, so that jumps stay); recruitment, fiber_stretch and fiber_direction (deformed, of unit length)
/// of family 1, and with ".2" and so on of further families that do not act alike, NaN in layers without such
/// a family.
class Fields final : public coupled::Picturing {
 public:
  Fields(const Setup& setup, const Assembler& assembler, int threads);

  std::vector<observables::FieldSeries> empty_series() const override;
  void append(double time, std::span<const double> y,
              std::span<observables::FieldSeries> series) const override;

 private:
  struct BloodPoint {
    int node;
    std::vector<int> corners;  ///< whose pressures' mean is that at the node
  };
  struct WallPoint {
    int node;
    int layer;
    int places;  ///< in the layer's cells that meet there
  };
  void add_blood();
  void add_wall(int threads);
  void show(int cell, std::span<const int> points, observables::FieldSeries& series) const;
  std::vector<std::vector<float>> blood_values(std::span<const double> y) const;
  std::vector<std::vector<float>> wall_values(std::span<const double> y) const;

  const Setup& setup_;
  const Layout& layout_;
  Basis basis_;
  std::vector<std::vector<int>> shown_;  ///< cells of the picture that a cell is shown as, by its nodes
  std::vector<BloodPoint> blood_points_;
  std::vector<WallPoint> wall_points_;
  std::vector<int> point_of_place_;  ///< of the probe
  std::unique_ptr<WallProbe> probe_;
  std::vector<int> families_;  ///< that are shown, of any layer
  observables::FieldSeries blood_, wall_;
};

}  // namespace tunica::full3d
