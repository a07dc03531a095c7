// SPDX-License-Identifier: GPL-3.0-or-later
// The catalog against the paper's Table 1, laws as scenes give them, and derivatives with respect to
// parameters.
#include "core/wall/from_scene.hpp"

#include <gtest/gtest.h>

#include <map>
#include <numbers>
#include <sstream>

#include "tests/support/law_cases.hpp"

namespace tunica::test_support {
namespace {

constexpr double degree = std::numbers::pi / 180;
const wall::MaterialAxes axes{{0, 1, 0}, {0, 0, 1}};

template <class P = double>
wall::Wall<P> wall_of(const std::string& text, const std::vector<std::string>& overrides = {},
                      const std::string& seed = {}) {
  const Scene scene = parse_scene(text, "wall.toml", ".", overrides);
  return wall::wall_from_scene(SeededScene<P>(scene, seed));
}

template <template <class> class Matrix>
const wall::SplitLaw<double, Matrix>& as_split(const wall::Law<double>& law) {
  return std::get<wall::SplitLaw<double, Matrix>>(law);
}

TEST(Catalog, HoldsThePapersTable1) {
  const std::map<std::string_view, std::map<std::string_view, double>> table{
      {"EXP1", {{"stiffness", 7.6350e4}, {"stiffening", 0.7410}}},
      {"EXP2", {{"stiffness", 6.8220e4}, {"stiffening", 0.0609}}},
      {"EXP1+EXP2-ZS",
       {{"stiffness", 1.7471e4},
        {"stiffening", 0.8620},
        {"fiber_stiffness", 1.4979e5},
        {"fiber_stiffening", 0.5736},
        {"fiber_angle", 56.52}}},
      {"EXP1+EXP2-FS",
       {{"stiffness", 3.5270e4},
        {"stiffening", 0.3424},
        {"fiber_stiffness", 1.3370e5},
        {"fiber_stiffening", 0.2141},
        {"fiber_angle", 42.82},
        {"activation_stretch", 1.5009}}}};
  for (const auto& [name, parameters] : table) {
    const wall::LawEntry* entry = wall::find_law(name);
    ASSERT_NE(entry, nullptr) << name;
    ASSERT_EQ(entry->parameters.size(), parameters.size()) << name;
    for (const auto& [key, value] : entry->parameters) {
      ASSERT_TRUE(parameters.contains(key)) << name << " " << key;
      EXPECT_EQ(value, parameters.at(key)) << name << " " << key;
      EXPECT_TRUE(wall::law_reads(*entry, key));
    }
    EXPECT_TRUE(wall::law_reads(*entry, "bulk_modulus"));
    EXPECT_EQ(wall::law_reads(*entry, "exponent"), parameters.contains("fiber_angle"));
    EXPECT_EQ(wall::law_reads(*entry, "activation_squared"), parameters.contains("activation_stretch"));
  }
  EXPECT_EQ(wall::find_law("EXP3"), nullptr);
  EXPECT_FALSE(wall::law_reads(*wall::find_law("EXP1"), "fiber_angle"));
  EXPECT_FALSE(wall::law_reads(*wall::find_law("linear-elastic"), "bulk_modulus"));
  EXPECT_FALSE(wall::law_reads(*wall::find_law("St-Venant-Kirchhoff"), "incompressible"));
}

TEST(WallFromScene, TheDefaultIsThePapersFiniteStrainLawInOneLayer) {
  const auto wall = wall_of("[wall]\n");
  ASSERT_EQ(wall.size(), 1u);
  EXPECT_EQ(wall[0].share, 1.0);
  const auto& law = as_split<wall::Exp1>(wall[0].law);
  EXPECT_EQ(law.volumetric.bulk_modulus, 9e6);
  EXPECT_EQ(law.matrix.stiffness, 3.5270e4);
  EXPECT_EQ(law.matrix.stiffening, 0.3424);
  ASSERT_EQ(law.families.size(), 2u);
  for (const auto& family : law.families) {
    EXPECT_EQ(family.weight, 1.0);
    EXPECT_EQ(family.stiffness, 1.3370e5);
    EXPECT_EQ(family.stiffening, 0.2141);
    EXPECT_EQ(family.exponent, 2);
    EXPECT_FALSE(family.recruitment.sharp);
    EXPECT_EQ(family.recruitment.sharpness, 5e5);
  }
  EXPECT_NEAR(law.families[0].angle, 42.82 * degree, 1e-16);
  EXPECT_NEAR(law.families[1].angle, -42.82 * degree, 1e-16);
}

TEST(WallFromScene, ParametersReachTheirLaws) {
  EXPECT_EQ(as_split<wall::Exp2>(wall_of("[wall]\nlaw = \"EXP2\"\nstiffness = 5e4\nstiffening = 0.07")[0].law)
                .matrix.stiffness,
            5e4);
  EXPECT_EQ(as_split<wall::NeoHookean>(wall_of("[wall]\nlaw = \"neo-Hookean\"\nshear_modulus = 3e5")[0].law)
                .matrix.shear_modulus,
            3e5);
  const auto compressible =
      wall_of("[wall]\nlaw = \"neo-Hookean-compressible\"\nshear_modulus = 3e5\nbulk_modulus = 1e6")[0].law;
  const auto& neo = std::get<wall::EnergyLaw<wall::NeoHookeanCompressible<double>>>(compressible).density;
  EXPECT_EQ(neo.shear_modulus, 3e5);
  EXPECT_EQ(neo.bulk_modulus, 1e6);
  const auto svk =
      wall_of("[wall]\nlaw = \"St-Venant-Kirchhoff\"\nyoung_modulus = 2e6\npoisson_ratio = 0.4")[0].law;
  EXPECT_EQ(std::get<wall::EnergyLaw<wall::StVenantKirchhoff<double>>>(svk).density.poisson_ratio, 0.4);
  const auto linear = wall_of("[wall]\nlaw = \"linear-elastic\"\nyoung_modulus = 2e6")[0].law;
  EXPECT_EQ(std::get<wall::EnergyLaw<wall::LinearElastic<double>>>(linear).density.young_modulus, 2e6);
  EXPECT_TRUE(wall::families(linear).empty());

  const auto fs = wall_of("[wall]\nactivation_squared = 1.52\nexponent = 1\nrecruitment = \"sharp\"")[0].law;
  for (const auto& family : wall::families(fs)) {
    EXPECT_EQ(family.activation_squared, 1.52);
    EXPECT_EQ(family.exponent, 1);
    EXPECT_TRUE(family.recruitment.sharp);
  }
}

TEST(WallFromScene, LayersHaveTheirOwnSharesLawsAndFamilies) {
  const auto wall = wall_of(R"(
[wall]
law = "EXP1+EXP2-FS"
bulk_modulus = 8e6
[[wall.layers]]
fraction = 0.25
law = "EXP1"
stiffness = 3e4
[[wall.layers]]
fraction = 0.75
fiber_angle = 20
)");
  ASSERT_EQ(wall.size(), 2u);
  EXPECT_EQ(wall[0].share, 0.25);
  EXPECT_EQ(wall[1].share, 0.75);
  const auto& inner = as_split<wall::Exp1>(wall[0].law);
  EXPECT_EQ(inner.matrix.stiffness, 3e4);
  EXPECT_EQ(inner.matrix.stiffening, 0.7410);
  EXPECT_EQ(inner.volumetric.bulk_modulus, 8e6);
  EXPECT_TRUE(inner.families.empty());
  const auto& outer = as_split<wall::Exp1>(wall[1].law);
  EXPECT_EQ(outer.matrix.stiffness, 3.5270e4);
  ASSERT_EQ(outer.families.size(), 2u);
  EXPECT_NEAR(outer.families[0].angle, 20 * degree, 1e-16);
  const double c = std::cos(20 * degree), s = std::sin(20 * degree);
  EXPECT_NEAR(outer.families[0].activation_squared, 1.5009 * 1.5009 * c * c + s * s, 1e-15);
}

struct ParameterCase {
  const char* law;
  const char* parameter;
  double value;
};

std::ostream& operator<<(std::ostream& out, const ParameterCase& c) {
  return out << c.law << " " << c.parameter;
}

class ParameterDerivative : public testing::TestWithParam<ParameterCase> {};

TEST_P(ParameterDerivative, OfTheStressIsThatOfDifferences) {
  const std::string law = GetParam().law, parameter = GetParam().parameter;
  const double value = GetParam().value;
  const std::string text = "[wall]\nlaw = \"" + law + "\"\n";
  // A sharpness of 100 lets the parameter act through the recruited share too.
  const bool has_fibers = wall::find_law(law)->has_fibers;
  const std::vector<std::string> base =
      has_fibers ? std::vector<std::string>{"wall.sharpness=100"} : std::vector<std::string>{};
  const auto with = [&](double at) {
    auto overrides = base;
    std::ostringstream text_of_number;
    text_of_number.precision(17);
    text_of_number << parameter << "=" << at;
    overrides.push_back(text_of_number.str());
    return overrides;
  };
  using D = Dual<double, 1>;
  const auto seeded = wall_of<D>(text, with(value), parameter)[0].law;
  const double step = 1e-4 * value;
  const auto far_below = wall_of(text, with(value - 2 * step))[0].law,
             below = wall_of(text, with(value - step))[0].law;
  const auto above = wall_of(text, with(value + step))[0].law,
             far_above = wall_of(text, with(value + 2 * step))[0].law;
  RandomDeformation random;
  SCOPED_TRACE(random.origin());
  for (int sample = 0; sample < 20; ++sample) {
    // Around the ring at lumen stretches of 1.2 to 1.6, where FS fibres are being recruited, then at random.
    const double l = 1.2 + 0.04 * sample;
    const auto H =
        sample < 10 ? Tensor<double>::diagonal(0.99 / l - 1, l - 1, 0) : random.displacement_gradient();
    const auto dual_stress = wall::piola(seeded, lift<D>(H), axes);
    Tensor<double> derivative;
    for (int k = 0; k < 9; ++k) derivative.entries[k] = dual_stress.entries[k].derivative[0];
    const auto difference =
        (1 / (12 * step)) * (8.0 * (wall::piola(above, H, axes) - wall::piola(below, H, axes)) -
                             (wall::piola(far_above, H, axes) - wall::piola(far_below, H, axes)));
    // Five points: truncation step^4 (100 d(a^2)/dp)^5 of the stress, 1e-6 of its derivative; and rounding of
    // the stress, whose scale is the bulk modulus, over the step.
    expect_near(derivative, difference,
                1e-6 * largest(derivative) + 1e-14 * stress_scale(below, H, axes) / step);
  }
}

const ParameterCase parameter_cases[] = {{"EXP1+EXP2-FS", "wall.activation_stretch", 1.5009},
                                         {"EXP1+EXP2-FS", "wall.activation_squared", 1.52},
                                         {"EXP1+EXP2-FS", "wall.fiber_angle", 42.82},
                                         {"EXP1+EXP2-FS", "wall.bulk_modulus", 9e6},
                                         {"EXP1+EXP2-FS", "wall.fiber_stiffness", 1.3370e5},
                                         {"EXP1+EXP2-FS", "wall.stiffening", 0.3424},
                                         {"EXP1+EXP2-FS", "wall.sharpness", 100},
                                         {"EXP1+EXP2-ZS", "wall.fiber_angle", 56.52},
                                         {"EXP1+EXP2-ZS", "wall.fiber_stiffening", 0.5736},
                                         {"EXP1", "wall.stiffness", 7.6350e4},
                                         {"EXP2", "wall.stiffening", 0.0609},
                                         {"neo-Hookean", "wall.shear_modulus", 7.6350e4},
                                         {"neo-Hookean-compressible", "wall.shear_modulus", 7.6350e4},
                                         {"neo-Hookean-compressible", "wall.bulk_modulus", 9e6},
                                         {"St-Venant-Kirchhoff", "wall.young_modulus", 3e6},
                                         {"St-Venant-Kirchhoff", "wall.poisson_ratio", 0.3},
                                         {"linear-elastic", "wall.poisson_ratio", 0.3}};

INSTANTIATE_TEST_SUITE_P(Catalog, ParameterDerivative, testing::ValuesIn(parameter_cases));

TEST(ParameterDerivative, IsZeroForAParameterOfAnotherLayer) {
  const std::string text =
      "[[wall.layers]]\nfraction = 0.5\nstiffness = 2e4\n[[wall.layers]]\nfraction = 0.5\nstiffness = 3e4\n";
  using D = Dual<double, 1>;
  const auto wall = wall_of<D>(text, {}, "wall.layers[1].stiffness");
  const auto H = Tensor<double>::diagonal(-0.2, 0.25, 0);
  EXPECT_EQ(wall::piola(wall[0].law, lift<D>(H), axes)(1, 1).derivative[0], 0.0);
  EXPECT_GT(wall::piola(wall[1].law, lift<D>(H), axes)(1, 1).derivative[0], 0.1);
}

}  // namespace
}  // namespace tunica::test_support
