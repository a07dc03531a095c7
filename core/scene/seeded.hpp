// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <concepts>
#include <string>

#include "core/dual.hpp"
#include "core/scene/scene.hpp"

namespace tunica {

/// Numbers of a scene as scalars P. With P a dual, the parameter named `seed` is the independent
/// variable, so that whatever is built from these numbers carries its derivative.
template <class P>
class SeededScene {
 public:
  explicit SeededScene(const Scene& scene, std::string seed = {}) : scene_(scene), seed_(std::move(seed)) {}

  P number(std::string_view key) const {
    const double value = scene_.number(key);
    if constexpr (!std::same_as<P, double>) {
      if (key == seed_) {
        seed_was_read_ = true;
        return P::variable(value);
      }
    }
    return P(value);
  }

  const Scene& scene() const { return scene_; }
  /// False when the model that was built does not depend on the seed.
  bool seed_was_read() const { return seed_was_read_; }

 private:
  const Scene& scene_;
  std::string seed_;
  mutable bool seed_was_read_ = false;
};

}  // namespace tunica
