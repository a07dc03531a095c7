// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/coupled/layout.hpp"

#include <algorithm>

namespace tunica::coupled {

Layout::Layout(const LayoutSpec& spec)
    : components_(spec.components),
      mesh_follows_(spec.mesh_follows),
      mesh_couples_(spec.mesh_couples),
      pressure_index_(spec.on_wall.size(), -1),
      on_wall_(spec.on_wall),
      has_displacement_(spec.has_displacement),
      has_velocity_(spec.has_velocity) {
  int count = 0;
  for (int node = 0; node < nodes(); ++node) {
    if (spec.has_pressure[node]) pressure_index_[node] = count++;
    if (on_wall_[node]) wall_nodes_.push_back(node);
  }
  velocity_ = static_cast<std::size_t>(components_) * nodes();
  pressure_ = 2 * velocity_;
  scalar_ = pressure_ + static_cast<std::size_t>(count);
  size_ = scalar_;
  if (spec.inlet_pressure) inlet_pressure = size_++;
  if (spec.outlet_pressure) outlet_pressure = size_++;
  if (spec.windkessel_pressure) windkessel_pressure = size_++;
  number(spec);
}

void Layout::number(const LayoutSpec& spec) {
  unknown_.assign(size_, -1);
  constexpr int wanted = -2;
  for (int node = 0; node < nodes(); ++node) {
    for (int c = 0; c < components_; ++c) {
      if (has_displacement_[node]) unknown_[displacement(node, c)] = wanted;
      if (has_velocity_[node] && !on_wall_[node]) unknown_[velocity(node, c)] = wanted;
    }
    if (has_pressure(node)) unknown_[pressure(node)] = wanted;
  }
  for (std::size_t s = scalar_; s < size_; ++s) unknown_[s] = wanted;

  if (!spec.shares.empty()) shared_index_.assign(velocity_, -1);
  for (const auto& share : spec.shares) {
    const std::size_t entry = displacement(share.node, share.component);
    unknown_[entry] = -1;
    shared_index_[entry] = static_cast<int>(shared_.size());
    shared_.push_back(
        {entry, displacement(share.of, share.component), displacement(share.of, 0), share.share, share.lean});
  }

  for (const auto& fixed : spec.fixed) {
    const std::size_t entry =
        fixed.is_velocity ? velocity(fixed.node, fixed.component) : displacement(fixed.node, fixed.component);
    if (unknown_[entry] != wanted) continue;
    unknown_[entry] = -1;
    prescribed_.push_back({entry, fixed.node, fixed.component, fixed.is_velocity});
  }

  if (mesh_follows_) follower_.assign(velocity_, -1);
  const auto give_number = [&](std::size_t entry) {
    if (unknown_[entry] != wanted) return;
    if (mesh_follows_ && entry < velocity_ && !on_wall_[node_of(entry)]) {
      unknown_[entry] = -1;
      follower_[entry] = static_cast<int>(followers_.size());
      followers_.push_back(entry);
      return;
    }
    unknown_[entry] = static_cast<int>(entries_.size());
    entries_.push_back(entry);
  };
  for (const int node : spec.order) {
    for (int c = 0; c < components_; ++c) {
      give_number(displacement(node, c));
      give_number(velocity(node, c));
    }
    if (has_pressure(node)) give_number(pressure(node));
  }
  for (std::size_t s = scalar_; s < size_; ++s) give_number(s);
}

void Layout::share_out(std::span<double> y) const {
  for (const SharedEntry& shared : shared_)
    y[shared.entry] = shared.share * y[shared.of] + shared.lean * y[shared.first];
}

Layout::Column Layout::column(std::size_t entry) const {
  const int index = entry < shared_index_.size() ? shared_index_[entry] : -1;
  if (index < 0) return {unknown_[entry], 1, 0};
  const SharedEntry& shared = shared_[index];
  // Where the mesh is given within a step nothing depends on the wall.
  if (mesh_follows_) return {-1, 0, 0};
  return {unknown_[shared.of], shared.share, shared.lean};
}

int Layout::node_of(std::size_t entry) const {
  if (entry < velocity_) return static_cast<int>(entry / components_);
  if (entry < pressure_) return static_cast<int>((entry - velocity_) / components_);
  const auto found =
      std::find(pressure_index_.begin(), pressure_index_.end(), static_cast<int>(entry - pressure_));
  return static_cast<int>(found - pressure_index_.begin());
}

}  // namespace tunica::coupled
