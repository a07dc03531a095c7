// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/radial/from_scene.hpp"

#include <fmt/format.h>

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

}  // namespace

template <class P>
Ring<P> ring_from_scene(const SeededScene<P>& scene) {
  return {scene.number("geometry.radius"),           scene.number("geometry.thickness"),
          scene.number("tether.stiffness"),          traction_from(scene.scene().text("tether.traction")),
          scene.scene().flag("wall.incompressible"), wall::wall_from_scene(scene)};
}

template Ring<double> ring_from_scene(const SeededScene<double>&);
template Ring<Dual<double, 1>> ring_from_scene(const SeededScene<Dual<double, 1>>&);

std::unique_ptr<const RingModel> ring_model(const Scene& scene, const std::vector<std::string>& parameters) {
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
  return std::make_unique<CompressibleRing>(std::move(ring), std::move(seeded));
}

}  // namespace tunica::radial
