// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/coupled/vessel_run.hpp"
#include "full3d/assembler.hpp"
#include "full3d/wall_line.hpp"

namespace tunica::full3d {

/// Turns states of the vessel into the tables of a result. P1..P4 divide the wall at mid-length from the
/// inner to the outer surface, at angle 0 of the vessel's Course: in a torus the outside of the bend. Where
/// it has further angles (90, 180, which is the inside of the bend, and 270 degrees) the table has columns
/// for them: "radial_displacement.P1.90deg", and so on.
class Observer final : public coupled::Observing {
 public:
  Observer(const Setup& setup, const Assembler& assembler);
  Observer(const Observer&) = delete;
  Observer& operator=(const Observer&) = delete;

  observables::Table observables_table() const override;
  void append_observables(double time, std::span<const double> y, observables::Table& table) const override;
  void append_profile(double time, std::span<const double> y, observables::Table& profiles) const override;
  /// along.csv, a row for each point of Course::along.
  observables::Table along_table() const override { return observables::along_table(); }
  void append_along(double time, std::span<const double> y, observables::Table& along) const override;

  /// At angle 0; families act alike there when their |angle| and threshold are equal and the
  /// wall is its own mirror image.
  int events() const override { return static_cast<int>(events_.size()); }
  void event_values(std::span<const double> y, double* values) const override;
  observables::EventPlace event_place(int event) const override { return events_[event]; }

  observables::Sample sample(double time, std::span<const double> y) const;

 private:
  struct LineNode {
    double s, radius;                ///< along the centreline, and from it
    std::size_t blood, blood_count;  ///< places of the probe
    std::size_t wall, wall_count;
    int layer;
    Directions directions;
  };
  void find_line(const Course& course, const Locator& locator);
  void fill(const WallLine& line, std::span<const double> y, std::span<observables::WallPoint> points,
            std::vector<WallState>* states = nullptr) const;
  double shear_stress(const Directions& directions, const BloodSample& blood) const;
  const wall::Law<double>& law(int layer) const { return setup_.problem.laws[layer]; }

  const Setup& setup_;
  const Assembler& assembler_;
  std::vector<int> further_angles_;
  std::function<double(std::span<const double>)> section_pressure_;  ///< empty without blood
  std::vector<std::unique_ptr<const WallLine>> points_;              ///< by angle, 0 first
  std::unique_ptr<const WallLine> profile_;
  std::vector<LineNode> line_;
  std::unique_ptr<BloodProbe> line_blood_;
  std::unique_ptr<WallProbe> line_wall_;
  std::vector<observables::EventPlace> events_;
};

}  // namespace tunica::full3d
