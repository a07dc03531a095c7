// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "core/radial/compressible_ring.hpp"
#include "core/radial/from_scene.hpp"
#include "core/radial/incompressible_ring.hpp"
#include "core/scene/scene.hpp"

namespace tunica::test_support {

/// The paper's cylinder, changed by overrides ("tether.stiffness=0").
inline Scene scene_with(const std::vector<std::string>& overrides, const std::string& folder = ".") {
  return parse_scene("[time]\nbeats = 2\n", "test", folder, overrides);
}

inline radial::Ring<double> ring_with(const std::vector<std::string>& overrides) {
  const Scene scene = scene_with(overrides);
  return radial::ring_from_scene(SeededScene<double>(scene));
}

inline std::unique_ptr<const radial::RingModel> model_with(const std::vector<std::string>& overrides,
                                                           const std::vector<std::string>& parameters = {}) {
  return radial::ring_model(scene_with(overrides), parameters);
}

inline std::vector<std::string> joined(std::vector<std::string> first, const std::vector<std::string>& more) {
  first.insert(first.end(), more.begin(), more.end());
  return first;
}

/// The paper's four laws.
inline constexpr std::array paper_laws{"EXP1", "EXP2", "EXP1+EXP2-ZS", "EXP1+EXP2-FS"};
inline constexpr std::array tether_readings{"normal", "reference", "current"};

}  // namespace tunica::test_support
