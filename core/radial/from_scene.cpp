// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/radial/from_scene.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"
#include "core/radial/compressible_ring.hpp"
#include "core/radial/incompressible_ring.hpp"
#include "core/wall/from_scene.hpp"

namespace tunica::radial {

namespace {

TetherTraction traction_from(const std::string& name) {
  if (name == "reference") return TetherTraction::reference;
  if (name == "current") return TetherTraction::current;
  return TetherTraction::normal;
}

/// Elements that a response of this accuracy takes: w is smooth between the fronts, and each degree gains
/// more than an order of magnitude (docs/theory/core.md, "The thick ring").
CompressibleRing::Options options_for(double accuracy) {
  if (accuracy < 1e-8) return {};
  const int degree = accuracy < 1e-6 ? 8 : 5;
  // The last step takes an error to its square; w is itself a small part of the motion.
  return {.degree = degree,
          .points = degree + 1,
          .accuracy = accuracy,
          .left_by_newton = 0.1 * std::sqrt(accuracy),
          .kink = 0.1 * std::sqrt(accuracy)};
}

}  // namespace

template <class P>
Ring<P> ring_from_scene(const SeededScene<P>& scene) {
  return {scene.number("geometry.radius"),           scene.number("geometry.thickness"),
          scene.number("tether.stiffness"),          traction_from(scene.scene().text("tether.traction")),
          scene.scene().flag("wall.incompressible"), wall::wall_from_scene(scene)};
}

template Ring<double> ring_from_scene(const SeededScene<double>&);
template Ring<Dual<double, 1>> ring_from_scene(const SeededScene<Dual<double, 1>>&);

std::unique_ptr<const RingModel> ring_model(const Scene& scene, const std::vector<std::string>& parameters,
                                            double accuracy) {
  Ring<double> ring = ring_from_scene(SeededScene<double>(scene));
  std::vector<RingModel::Seeded> seeded;
  for (const auto& parameter : parameters)
    seeded.push_back(ring_from_scene(SeededScene<Dual<double, 1>>(scene, parameter)));
  if (ring.incompressible) return std::make_unique<IncompressibleRing>(std::move(ring), std::move(seeded));
  for (const auto& layer : ring.layers)
    for (const auto& family : wall::families(layer.law))
      if (family.exponent == 1 && family.recruitment.sharp)
        throw InvalidInput(
            "wall.recruitment = \"sharp\" with wall.exponent = 1: the stress would jump, and compressible "
            "tissue then lingers at the threshold partly recruited, which a step cannot express; use "
            "recruitment = \"smooth\" or incompressible = true");
  return std::make_unique<CompressibleRing>(std::move(ring), std::move(seeded), options_for(accuracy));
}

}  // namespace tunica::radial
