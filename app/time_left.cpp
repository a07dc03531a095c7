// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/time_left.hpp"

#include <algorithm>
#include <cstddef>

namespace tunica {

void TimeLeft::note(double spent, double time) {
  moments_.push_back({spent, time});
  // Every second one tells as much, and a run may have millions.
  constexpr std::size_t most = 2000;
  if (moments_.size() < most) return;
  std::deque<Moment> kept;
  for (std::size_t k = 0; k < moments_.size(); k += 2) kept.push_back(moments_[k]);
  if (kept.back().spent != moments_.back().spent) kept.push_back(moments_.back());
  moments_ = std::move(kept);
}

std::optional<double> TimeLeft::until(double end) const {
  constexpr std::size_t fewest = 10;
  if (moments_.size() < fewest) return {};
  const Moment &first = moments_.front(), &last = moments_.back();
  const double half = 0.5 * (first.spent + last.spent);
  const auto middle =
      std::lower_bound(moments_.begin(), moments_.end(), half,
                       [](const Moment& moment, double spent) { return moment.spent < spent; });
  const double former = (middle->time - first.time) / (middle->spent - first.spent);
  const double latter = (last.time - middle->time) / (last.spent - middle->spent);
  constexpr double near = 2;
  if (!(former > 0 && latter > 0 && latter < near * former && former < near * latter)) return {};
  return (end - last.time) / latter;
}

}  // namespace tunica
