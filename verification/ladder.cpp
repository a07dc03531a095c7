// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/ladder.hpp"

namespace tunica::verification {

namespace {

/// Odd, so that one compartment has its middle at mid-length; the error of the chain falls with the square.
Rung compartments() {
  return {"compartments",
          {"lumped.compartments=21"},
          "loss and compliance spread along the artery",
          [](const Scene& scene) { return scene.integer("lumped.compartments") > 1; }};
}

Rung inertance() {
  return {"inertance", {"lumped.inertance=true"}, "inertia of the blood"};
}

Rung natural_inlet() {
  return {"natural", {"inlet.profile=natural"}, "entrance flow"};
}

Rung sliding_ends() {
  return {"sliding", {"geometry.ends=sliding"}, "clamped ends"};
}

Rung straight() {
  return {"straight", {"geometry.kind=cylinder"}, "bend"};
}

}  // namespace

const std::vector<Ladder>& ladders() {
  static const std::vector<Ladder> all{
      {"lumped", "axisym", {compartments(), inertance()}, {natural_inlet(), sliding_ends()}},
      {"lumped", "full3d", {compartments(), inertance()}, {straight(), natural_inlet(), sliding_ends()}}};
  return all;
}

}  // namespace tunica::verification
