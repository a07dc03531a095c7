// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/run/quantity.hpp"
#include "core/run/scene_source.hpp"

namespace tunica::verification::calibration {

/// A key of the scene that is looked for between two bounds. The search works on u, 0 at the lower and 1 at
/// the upper one, in between by the logarithm where both are above 0.
struct FreeKey {
  std::string key;
  std::string unit;  ///< "1" for none
  double low = 0, high = 1;

  bool is_log() const { return low > 0; }
  double value(double u) const;
  double slope(double u) const;      ///< d(value)/du
  double place(double value) const;  ///< u of a value, cut off at the bounds
};

/// What a quantity of the run is to be.
struct Target {
  run::Quantity quantity;
  double value = 0;               ///< in the quantity's unit
  double standard_deviation = 0;  ///< likewise
  bool deviation_given = false;   ///< false: Target::usual_share of the value stands in for it
  std::string asked;              ///< as it was written

  static constexpr double usual_share = 0.01;
};

/// Reads "KEY=LO:HI", numbers in the key's unit or with their own. Throws InvalidInput as sweep::parse_axis
/// does, and for keys that hold no number or whose bounds the scene refuses.
FreeKey parse_free(const std::string& text, const run::SceneSource& source);

/// Reads "QUANTITY=VALUE" or "QUANTITY=VALUE+-SD". VALUE: "130 mmHg", a plain number in the quantity's
/// unit, or a share of a key, "25 % of geometry.radius". SD likewise, where a percentage is one of the value;
/// of VALUE and SD a plain number has the other's unit. Throws InvalidInput for what is none of these, for
/// shares of a key that is free or of another dimension, and for a value of 0 without a standard deviation.
Target parse_target(const std::string& text, const Scene& scene, const std::vector<FreeKey>& free);

}  // namespace tunica::verification::calibration
