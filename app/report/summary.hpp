// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/observables/beat.hpp"
#include "core/observables/result.hpp"

namespace tunica::report {

/// A run as the report speaks of it.
struct RunSummary {
  const StoredResult* stored = nullptr;
  std::string label;  ///< tells the runs of this report apart, see labels_of
  std::string name;   ///< of the scene
  std::string law;
  std::string tier;
  std::string state;  ///< "done", "not converged", "interrupted", or the failure
  bool is_complete = true;
  bool is_state = false;  ///< one row: a static state, or a run that stopped at once
  observables::Beat beat;
  double period_end = 0;  ///< s, the run's last output time

  observables::Range pressure;                ///< mmHg, over the last beat, as all below
  observables::Range transmural_pressure;     ///< mmHg
  double radius_change = observables::none;   ///< (largest - smallest inner radius) / R0
  double largest_radius = observables::none;  ///< largest inner displacement / R0
  double systole = observables::none;         ///< s from the start of the beat, peak of the inflow
  observables::Range angle_at_start;          ///< deg, over P1..P4
  observables::Range angle_at_systole;        ///< deg, over P1..P4
  std::array<double, observables::wall_points> recruited_share{};  ///< 0 to 1
};

/// Throws InvalidInput when a run has no rows.
std::vector<RunSummary> summarize(const std::vector<StoredResult>& runs);

}  // namespace tunica::report
