// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace tunica::verification {

/// A table for people (markdown) and for programs (CSV).
struct RippleTable {
  std::string name;   ///< of the CSV file
  std::string title;  ///< of the section
  std::string text;   ///< above the table, markdown
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

/// What docs/verification/tether-stability.md shows: where the paper's wall ripples under the three readings
/// of its tether. Takes some ten seconds.
std::vector<RippleTable> ripple_tables();

/// Growth rates over lumen pressure and wave length, for a picture: columns law, pressure[mmHg],
/// wave_length[cm], growth_rate[1/s].
RippleTable growth_map();

}  // namespace tunica::verification
