// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/coupled/equations.hpp"

namespace tunica::coupled {

/// Looks for blood that turns back on the inlet: that leaves through a part of it while more comes in through
/// the rest. Of a flow that a pressure drives in this is a sign that what is uniform over the inlet does not
/// decide the profile, and that nothing downstream can be relied on.
class InletWatch {
 public:
  /// Share of the greatest flow through the inlet that may leave against it: what reverses beside the wall
  /// of a pulsatile flow in earnest stays below.
  static constexpr double tolerated = 0.01;

  /// `still` is a flow that counts for none, cm3/s; `is_total` whether the inlet's pressure is a total one.
  InletWatch(double still, bool is_total) : still_(still), is_total_(is_total) {}

  /// What goes through the inlet at a time, outwards from the vessel.
  void look(double time, const Throughflow& inlet);
  /// What a user should know, one line; empty when all is well.
  std::string finding() const;

  /// What a run that is resumed goes on from.
  std::vector<double> save() const { return {greatest_, time_, leaving_, entering_}; }
  void restore(const std::vector<double>& saved);

 private:
  double still_;
  bool is_total_;
  double greatest_ = 0;                           ///< flow through the inlet, either way, cm3/s
  double time_ = 0, leaving_ = 0, entering_ = 0;  ///< when most left against the flow
};

}  // namespace tunica::coupled
