// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace tunica::verification {

/// A line through points, or the points alone as marks.
struct Series {
  std::string name;  ///< in the legend
  std::vector<double> x, y;
  bool line = true;
  bool marks = false;
};

struct LineChart {
  std::string title, x_label, y_label;
  std::vector<Series> series;  ///< more than one: with a legend, in the corner with the fewest points
  bool log_x = false, log_y = false;
  std::optional<std::array<double, 2>> y_range{};  ///< what the points span unless given
};

/// Charts in rows of `columns` as one SVG picture, as text.
/// Throws std::logic_error for a chart without points and for values <= 0 on a logarithmic axis.
std::string svg(const std::vector<LineChart>& charts, int columns = 2);

}  // namespace tunica::verification
