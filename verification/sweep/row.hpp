// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/run/door.hpp"

namespace tunica::sweep {

/// A point of a sweep that has ended.
struct Row {
  std::uint64_t point = 0;
  std::string status;  ///< run::name_of of its ending: done, gave-up or refused
  std::string reason;  ///< one line, empty when done
  std::string tier;
  double seconds = 0;
  std::vector<std::string> keys;  ///< values of what varies
  /// Quantities, then with gradients for each quantity one by each key; none where there is no such thing.
  std::vector<double> numbers;
};

/// A column of numbers of sweep.csv behind those of the keys.
struct NumberColumn {
  std::string name, unit;
  std::string head() const { return name + '[' + unit + ']'; }
};

/// The columns of a question's answer: "pressure.max" in "dyn/cm2", then "d(pressure.max)/d(KEY)" for each
/// quantity and key.
std::vector<NumberColumn> number_columns(const run::Question& question);

/// The numbers of an answer in that order.
std::vector<double> numbers_of(const run::Answer& answer);

}  // namespace tunica::sweep
