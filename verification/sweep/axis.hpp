// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "verification/uncertainty/marginal.hpp"

namespace tunica::sweep {

/// What one key of the scene takes on in a sweep.
struct Axis {
  std::string key;
  std::string unit;                 ///< of its numbers, "1" for none; empty for texts
  std::vector<std::string> values;  ///< of a grid, as overrides write them
  /// Of a sample: the range or distribution that its numbers are drawn from.
  std::optional<uncertainty::Marginal> marginal;

  bool is_number() const { return !unit.empty(); }
};

/// Reads what --vary, or another option of its kind, says:
///   KEY=LO:HI:N[:log]   N values from LO to HI, both included, equally spaced or, with log, in equal ratios
///   KEY=A,B,...         these values
///   KEY=LO:HI[:log]     for a sample: uniform between, or with log uniform in the logarithm
///   KEY=DISTRIBUTION    for a sample (uncertainty::parse_marginal)
/// Numbers are in the key's unit or carry their own. Throws InvalidInput for a key that is not declared or
/// takes no such values, and for ranges that are empty, reversed or of one point.
Axis parse_axis(const std::string& text, const std::string& option = "--vary");

/// The unit of a key's numbers ("1" for none), empty for keys that hold texts, choices or flags. Throws
/// InvalidInput for keys that are not declared, naming the nearest, and for those that hold lists.
std::string unit_of(const std::string& key, const std::string& option);

/// A number as an override writes it: the shortest text that reads back to it; whole for integer keys.
std::string value_text(double value);

}  // namespace tunica::sweep
