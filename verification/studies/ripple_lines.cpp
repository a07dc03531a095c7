// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/studies/ripple_lines.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

namespace tunica::verification {

std::vector<LumenLine> lumen_lines(const observables::Table& along) {
  const auto& time = along.find("time")->values;
  const auto& z = along.find("z")->values;
  const auto& radius = along.find("lumen_radius")->values;
  std::vector<LumenLine> lines;
  for (std::size_t row = 0; row < time.size(); ++row) {
    if (row == 0 || time[row] != time[row - 1]) lines.push_back({time[row], {}, {}});
    lines.back().z.push_back(z[row]);
    lines.back().radius.push_back(radius[row]);
  }
  return lines;
}

Ripples ripples(const LumenLine& line, double length) {
  std::vector<std::pair<double, double>> middle;
  for (std::size_t k = 0; k < line.z.size(); ++k)
    if (std::abs(line.z[k] - 0.5 * length) < 0.27 * length) middle.emplace_back(line.z[k], line.radius[k]);
  const auto n = static_cast<Eigen::Index>(middle.size());
  Eigen::MatrixXd powers(n, 4);
  Eigen::VectorXd radius(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double x = middle[k].first / length - 0.5;
    powers.row(k) << 1, x, x * x, x * x * x;
    radius[k] = middle[k].second;
  }
  const Eigen::VectorXd departure = radius - powers * powers.colPivHouseholderQr().solve(radius);
  Ripples found;
  int changes = 0;
  for (Eigen::Index k = 0; k < n; ++k) {
    found.amplitude = std::max(found.amplitude, std::abs(departure[k]));
    if (k > 0 && departure[k] * departure[k - 1] < 0) ++changes;
  }
  if (changes > 1) found.wave_length = 2 * (middle.back().first - middle.front().first) / changes;
  return found;
}

}  // namespace tunica::verification
