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

/// The unloaded vessel as pictures. Quadratic cells are shown as eight tetrahedra or, as they are long, as 2
/// x 2 x 4 hexahedra, so that their sides bend.
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
  /// Points of a series: where cells of a layer meet they share them.
  struct Points {
    std::vector<int> layers;             ///< by point
    std::vector<int> point_of_place;     ///< of the probe
    std::vector<double> share_of_place;  ///< in the mean at its point
    std::vector<Place> places;
  };
  Points points_of(Part part, observables::FieldSeries& series) const;
  std::vector<std::vector<float>> blood_values(std::span<const double> y) const;
  std::vector<std::vector<float>> wall_values(std::span<const double> y) const;

  const Setup& setup_;
  Points blood_points_, wall_points_;
  std::unique_ptr<BloodProbe> blood_probe_;
  std::unique_ptr<WallProbe> wall_probe_;
  std::vector<wall::MaterialAxes> axes_;  ///< by point of the wall
  std::vector<int> families_;             ///< that are shown, of any layer
  observables::FieldSeries blood_, wall_;
};

}  // namespace tunica::full3d
