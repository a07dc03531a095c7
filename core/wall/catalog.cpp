// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/wall/catalog.hpp"

#include <algorithm>
#include <array>

namespace tunica::wall {

const std::vector<LawEntry>& laws() {
  static const std::vector<LawEntry> entries{
      {"EXP1",
       Matrix::exp1,
       false,
       false,
       true,
       {{"stiffness", 7.6350e4}, {"stiffening", 0.7410}},
       "isotropic, exponential in I1-3 (paper eq. 10)"},
      {"EXP2",
       Matrix::exp2,
       false,
       false,
       true,
       {{"stiffness", 6.8220e4}, {"stiffening", 0.0609}},
       "isotropic, exponential in (I1-3)^2, no stiffness at rest (paper eq. 11)"},
      {"EXP1+EXP2-ZS",
       Matrix::exp1,
       true,
       false,
       true,
       {{"stiffness", 1.7471e4},
        {"stiffening", 0.8620},
        {"fiber_stiffness", 1.4979e5},
        {"fiber_stiffening", 0.5736},
        {"fiber_angle", 56.52}},
       "EXP1 elastin and two collagen families recruited from zero strain (paper eq. 14)"},
      {"EXP1+EXP2-FS",
       Matrix::exp1,
       true,
       true,
       true,
       {{"stiffness", 3.5270e4},
        {"stiffening", 0.3424},
        {"fiber_stiffness", 1.3370e5},
        {"fiber_stiffening", 0.2141},
        {"fiber_angle", 42.82},
        {"activation_stretch", 1.5009}},
       "EXP1 elastin and two collagen families recruited at finite strain (paper eq. 15)"},
      {"neo-Hookean",
       Matrix::neo_hookean,
       false,
       false,
       true,
       {{"shear_modulus", 7.6350e4}},
       "isochoric neo-Hookean solid with the volumetric term U(J)"},
      {"neo-Hookean-compressible",
       Matrix::neo_hookean_compressible,
       false,
       false,
       false,
       {{"shear_modulus", 7.6350e4}},
       "neo-Hookean solid without a volumetric split, lambda = bulk_modulus - 2/3 shear_modulus"},
      {"St-Venant-Kirchhoff",
       Matrix::st_venant_kirchhoff,
       false,
       false,
       false,
       {{"young_modulus", 3e6}, {"poisson_ratio", 0.3}},
       "linear between the Green-Lagrange strain and the second Piola-Kirchhoff stress"},
      {"linear-elastic",
       Matrix::linear_elastic,
       false,
       false,
       false,
       {{"young_modulus", 3e6}, {"poisson_ratio", 0.3}},
       "small strains, for comparison with linear theory"},
  };
  return entries;
}

const LawEntry* find_law(std::string_view name) {
  const auto& all = laws();
  const auto entry =
      std::find_if(all.begin(), all.end(), [&](const LawEntry& law) { return law.name == name; });
  return entry == all.end() ? nullptr : &*entry;
}

bool law_reads(const LawEntry& law, std::string_view key) {
  if (key == "bulk_modulus") return law.splits_volume || law.matrix == Matrix::neo_hookean_compressible;
  if (key == "incompressible") return law.splits_volume;
  if (key == "activation_squared") return law.has_activation;
  static constexpr std::array<std::string_view, 3> recruitment_keys{"exponent", "recruitment", "sharpness"};
  if (std::find(recruitment_keys.begin(), recruitment_keys.end(), key) != recruitment_keys.end())
    return law.has_fibers;
  return std::any_of(law.parameters.begin(), law.parameters.end(),
                     [&](const LawParameter& parameter) { return parameter.key == key; });
}

}  // namespace tunica::wall
