// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>

#include "axisym/interface_line.hpp"
#include "axisym/wall_line.hpp"
#include "core/coupled/vessel_run.hpp"

namespace tunica::axisym {

/// Turns states of the vessel (see Layout) into the tables of a result. Mid-length is half way between the
/// inlet and the outlet of the unloaded vessel; P1..P4 divide the wall there from the inner to the outer
/// surface. What a vessel has not (blood, wall, fibres) is observables::none.
class Observer final : public coupled::Observing {
 public:
  explicit Observer(const Assembler& assembler);
  Observer(const Observer&) = delete;
  Observer& operator=(const Observer&) = delete;

  /// One row of observables.csv. The pressure is the mean over the current section of the lumen; flow is that
  /// relative to an inlet and an outlet which do not move along their normals.
  observables::Sample sample(double time, std::span<const double> y) const;

  observables::Table observables_table() const override { return observables::standard_table(); }
  void append_observables(double time, std::span<const double> y, observables::Table& table) const override {
    observables::append(table, sample(time, y));
  }
  void append_profile(double time, std::span<const double> y, observables::Table& profiles) const override;

  /// along.csv, a row for each node of the interface.
  observables::Table along_table() const override { return observables::along_table(); }
  void append_along(double time, std::span<const double> y, observables::Table& along) const override;

  /// Families act alike here when their |angle| and threshold are equal.
  int events() const override { return static_cast<int>(events_.size()); }
  void event_values(std::span<const double> y, double* values) const override;
  observables::EventPlace event_place(int event) const override { return events_[event]; }

 private:
  double section_pressure(std::span<const double> y) const;
  const wall::Law<double>& law(const WallState& state) const;

  const Assembler& assembler_;
  WallReader reader_;
  InterfaceLine interface_;
  std::vector<SectionPoint> lumen_;             ///< at mid-length; empty without blood
  std::optional<WallLine> points_, profile_;    ///< P1..P4, and the profile
  std::optional<Vector<double>> outer_normal_;  ///< at P4, none where it is not on the outer surface
  std::vector<observables::EventPlace> events_;
};

}  // namespace tunica::axisym
