// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/observables/result.hpp"

namespace tunica::test_support {

/// What synthetic_run makes: smooth made-up curves with the shape of a run, for tests of what reads
/// results. They solve no equation.
struct SyntheticRun {
  std::string name = "cylinder";
  std::string law = "EXP1+EXP2-FS";  ///< laws without "+EXP2" get no fibre quantities
  std::string tether = "normal";
  double beats = 2;
  double interval = 1e-3;             ///< s between rows
  double lowest_pressure = 75;        ///< mmHg, in the last beat
  double highest_pressure = 130;      ///< mmHg
  double displacement_scale = 0.020;  ///< cm on the inner surface at the highest pressure
  bool with_sensitivities = false;
  bool with_length = false;  ///< curves along the artery
};

/// A result as read_result would return it. In the last beat pressure is exactly
/// lowest + (highest - lowest) s(t) with s = (1 - cos(2 pi (t - 0.2112 + T/2)/T))/2, so that its peak is
/// at 0.2112 s of the beat; displacement follows s too. Fibres at P1..P4 are recruited where s > 0.05,
/// 0.35, 0.65, 0.90.
StoredResult synthetic_run(const SyntheticRun& wanted);

/// A static state as read_result would return it: the single row of such a run at its peak, at 0 s, with the
/// profile there.
StoredResult synthetic_state(const SyntheticRun& wanted);

/// The thresholds of s above.
inline constexpr double synthetic_thresholds[4] = {0.05, 0.35, 0.65, 0.90};

}  // namespace tunica::test_support
