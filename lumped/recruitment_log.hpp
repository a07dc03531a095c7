// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/observables/result.hpp"
#include "lumped/integrator.hpp"
#include "lumped/network.hpp"

namespace tunica::lumped {

/// Collects when fibres are recruited and released, how these times depend on parameters, and for how
/// long fibres are recruited in the last beat.
class RecruitmentLog {
 public:
  RecruitmentLog(const Network& network, std::vector<std::string> parameters);

  /// Event functions of the integrator: the lumen stretch at mid-length less each threshold's.
  int events() const;
  void event_values(const double* y, double* values) const;

  /// A crossing that the integrator has stopped at.
  void record(const Integrator& integrator, const Crossing& crossing);
  /// The last beat begins in this state.
  void begin_last_beat(double time, const double* y);
  /// The run ends; recruited_time.csv is only known then.
  void end_last_beat(double time);

  /// Puts the tables into a result: events, event_sensitivities and, after end_last_beat, recruited_time.
  void store(Result& result) &&;

 private:
  struct Tally {
    double since;
    bool recruited;
    double total = 0;
    std::vector<double> derivatives;
  };
  std::vector<double> derivatives(const Integrator& integrator, const radial::Threshold& threshold) const;

  const Network& network_;
  std::vector<std::string> parameters_;
  observables::Table events_, sensitivities_, recruited_time_;
  std::vector<Tally> tallies_;  ///< one per threshold, in the last beat only
};

}  // namespace tunica::lumped
