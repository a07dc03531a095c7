// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/wall/from_scene.hpp"

#include <fmt/format.h>

#include <numbers>

#include "core/wall/catalog.hpp"

namespace tunica::wall {

namespace {

constexpr double degree = std::numbers::pi / 180;

/// Parameters of one tissue: the keys below `prefix` ("wall." or "wall.layers[1].").
template <class P>
class Tissue {
 public:
  Tissue(const SeededScene<P>& scene, std::string prefix) : scene_(scene), prefix_(std::move(prefix)) {}

  Law<P> law() const {
    const LawEntry& entry = *find_law(scene_.scene().text(prefix_ + "law"));
    switch (entry.matrix) {
      case Matrix::exp1:
        return split<Exp1>({number("stiffness"), number("stiffening")}, entry);
      case Matrix::exp2:
        return split<Exp2>({number("stiffness"), number("stiffening")}, entry);
      case Matrix::neo_hookean:
        return split<NeoHookean>({number("shear_modulus")}, entry);
      case Matrix::neo_hookean_compressible:
        return EnergyLaw<NeoHookeanCompressible<P>>{{number("shear_modulus"), number("bulk_modulus")}};
      case Matrix::st_venant_kirchhoff:
        return EnergyLaw<StVenantKirchhoff<P>>{{number("young_modulus"), number("poisson_ratio")}};
      case Matrix::linear_elastic:
        return EnergyLaw<LinearElastic<P>>{{number("young_modulus"), number("poisson_ratio")}};
    }
    throw std::logic_error("wall_from_scene: a law without a matrix");
  }

 private:
  P number(const std::string& key) const { return scene_.number(prefix_ + key); }
  bool has(const std::string& key) const { return scene_.scene().has(prefix_ + key); }

  template <template <class> class MatrixTerm>
  Law<P> split(MatrixTerm<P> matrix, const LawEntry& entry) const {
    SplitLaw<P, MatrixTerm> law{{has("bulk_modulus") ? number("bulk_modulus") : P(0.0)}, matrix, {}};
    if (entry.has_fibers) law.families = collagen(entry);
    return law;
  }

  std::vector<CollagenFamily<P>> collagen(const LawEntry& entry) const {
    const Recruitment<P> recruitment{number("sharpness"),
                                     scene_.scene().text(prefix_ + "recruitment") == "sharp"};
    const int exponent = static_cast<int>(scene_.scene().integer(prefix_ + "exponent"));
    const auto family = [&](const std::string& below, const std::string& fiber, const P& angle,
                            const P& weight) {
      P threshold(1.0);
      if (entry.has_activation)
        threshold = has(below + "activation_squared")
                        ? number(below + "activation_squared")
                        : activation_squared(number(below + "activation_stretch"), angle);
      return CollagenFamily<P>{angle,
                               weight,
                               number(below + fiber + "stiffness"),
                               number(below + fiber + "stiffening"),
                               threshold,
                               exponent,
                               recruitment};
    };
    std::vector<CollagenFamily<P>> families;
    const std::size_t count = scene_.scene().count(prefix_ + "families");
    for (std::size_t k = 0; k < count; ++k) {
      const std::string below = fmt::format("families[{}].", k);
      families.push_back(family(below, "", degree * number(below + "angle"), number(below + "weight")));
    }
    if (count == 0) {
      const P angle = degree * number("fiber_angle");
      families.push_back(family("", "fiber_", angle, P(1.0)));
      families.push_back(family("", "fiber_", -angle, P(1.0)));
    }
    return families;
  }

  const SeededScene<P>& scene_;
  std::string prefix_;
};

}  // namespace

template <class P>
Wall<P> wall_from_scene(const SeededScene<P>& scene) {
  Wall<P> wall;
  const std::size_t layers = scene.scene().count("wall.layers");
  for (std::size_t k = 0; k < layers; ++k) {
    const std::string prefix = fmt::format("wall.layers[{}].", k);
    wall.push_back({scene.number(prefix + "fraction"), Tissue<P>(scene, prefix).law()});
  }
  if (layers == 0) wall.push_back({P(1.0), Tissue<P>(scene, "wall.").law()});
  return wall;
}

template Wall<double> wall_from_scene(const SeededScene<double>&);
template Wall<Dual<double, 1>> wall_from_scene(const SeededScene<Dual<double, 1>>&);

}  // namespace tunica::wall
