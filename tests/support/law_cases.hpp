// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "core/wall/law.hpp"
#include "tests/support/random_deformation.hpp"
#include "tests/support/reference_law.hpp"

namespace tunica::test_support {

/// A law of the catalog as a scene gives it, with its reference.
struct LawCase {
  std::string name;  ///< also the name of the test
  const wall::LawEntry* entry;
  int exponent;  ///< of the fibres; 0 for a law without
  wall::Law<double> law;
  ReferenceLaw reference;
};

inline std::ostream& operator<<(std::ostream& out, const LawCase& law) {
  return out << law.name;
}

/// The law by name with its own parameters; overrides are of the form "wall.sharpness=100".
LawCase law_case(std::string_view law, const std::vector<std::string>& overrides = {});

/// Every law of the catalog, those with fibres once with exponent 2 and once with 1. A law that is added
/// to the catalog gets all tests that are instantiated with these.
std::vector<LawCase> law_cases();
/// Those with fibres, and those without.
std::vector<LawCase> fiber_law_cases();
std::vector<LawCase> isotropic_law_cases();
/// The same law with other recruitment: "sharp", or "smooth" of this sharpness.
LawCase with_recruitment(const LawCase& law, const std::string& recruitment, double sharpness = 5e5);

/// The name of a case as a test's name.
inline std::string case_name(const testing::TestParamInfo<LawCase>& info) {
  return info.param.name;
}

/// The law without its fibres.
wall::Law<double> without_fibers(const wall::Law<double>& law);
/// Distance of the family nearest to its threshold, |I4bar - a^2|; 1 for a law without fibres.
double distance_to_recruitment(const LawCase& law, const Tensor<double>& displacement_gradient,
                               const wall::MaterialAxes& axes);
/// True when all families are beyond their thresholds.
bool fully_recruited(const LawCase& law, const Tensor<double>& displacement_gradient,
                     const wall::MaterialAxes& axes);

/// The stress that a relative rounding error of 1 in F makes: the largest entry of the tangent.
double stress_scale(const wall::Law<double>& law, const Tensor<double>& displacement_gradient,
                    const wall::MaterialAxes& axes);

}  // namespace tunica::test_support
