// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/coupled/tangent_stability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tunica::coupled {

TangentStability least_mode(StiffnessAndMass& pencil) {
  TangentStability result;
  constexpr double rounding = 100 * std::numeric_limits<double>::epsilon();
  const auto free = pencil.free_motions();
  const double none = free.count > 0 ? rounding * free.scale : 0;  // what is closer to 0 is not told from it
  result.negative = pencil.negative(-none);
  if (free.count > 0) result.neutral = std::min(free.count, pencil.negative(none) - result.negative);
  // Bracket of the least eigenvalue: from 0 outwards in powers of ten.
  double low = -none, high = -none;
  const int passed = result.negative > 0 ? 0 : result.neutral;  // eigenvalues that come before it
  const auto comes_before = [&](double lambda) { return pencil.negative(lambda) > passed; };
  if (result.negative > 0) {
    for (low = std::min(-1.0, 10 * low); comes_before(low); low *= 10) high = low;
  } else {
    low = none;
    for (high = std::max(1.0, 10 * none); !comes_before(high); high *= 10) low = high;
  }
  while (std::abs(high - low) > 0.01 * std::max(std::abs(low), std::abs(high))) {
    const double middle = low * high > 0 ? std::copysign(std::sqrt(low * high), low) : 0.5 * (low + high);
    (comes_before(middle) ? high : low) = middle;
  }
  result.least_eigenvalue = 0.5 * (low + high);
  pencil.negative(low);
  return result;
}

double wave_length(std::vector<std::pair<double, double>> line) {
  std::sort(line.begin(), line.end());
  line.erase(std::unique(line.begin(), line.end()), line.end());
  // What has died away between ripples must not count with its noise.
  double greatest = 0;
  for (const auto& [z, u] : line) greatest = std::max(greatest, std::abs(u));
  std::erase_if(line, [&](const auto& point) { return std::abs(point.second) < 0.02 * greatest; });
  double first = 0, last = 0;
  int changes = 0;
  for (std::size_t k = 1; k < line.size(); ++k) {
    if (line[k].second * line[k - 1].second > 0) continue;
    const double z = 0.5 * (line[k].first + line[k - 1].first);
    if (changes++ == 0) first = z;
    last = z;
  }
  return changes > 1 ? 2 * (last - first) / (changes - 1) : 0.0;
}

void record_stability(const TangentStability& found, radial::TetherTraction tether, RunRecord& record) {
  record.resolution["negative_pivots"] = found.negative;
  if (found.neutral > 0) record.resolution["neutral_motions"] = found.neutral;
  record.resolution["least_eigenvalue"] = found.least_eigenvalue;
  if (found.negative == 0) return;
  const bool proven = tether != radial::TetherTraction::current;
  record.findings.push_back(
      fmt::format("the static state {} unstable: its stiffness on this mesh has {} negative direction{}, of "
                  "which the fastest grows as exp(t/{:.2g} s){}; {}",
                  proven ? "is" : "may be", found.negative, found.negative == 1 ? "" : "s",
                  1 / std::sqrt(-found.least_eigenvalue),
                  found.wave_length > 0 ? fmt::format(" as ripples of {:.3g} cm", found.wave_length) : "",
                  tether == radial::TetherTraction::normal
                      ? "a stiffer wall or tether would hold it"
                      : "tether.traction = \"normal\" is stable for the paper's laws"));
}

}  // namespace tunica::coupled
