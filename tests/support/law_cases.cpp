// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/law_cases.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "core/wall/from_scene.hpp"

namespace tunica::test_support {

namespace {

LawCase made(std::string name, std::string_view law, const std::vector<std::string>& overrides) {
  const Scene scene =
      parse_scene("[wall]\nlaw = \"" + std::string(law) + "\"\n", "law_case.toml", ".", overrides);
  const wall::LawEntry* entry = wall::find_law(law);
  return {std::move(name), entry, entry->has_fibers ? static_cast<int>(scene.integer("wall.exponent")) : 0,
          wall::wall_from_scene(SeededScene<double>(scene)).front().law, reference_law(scene)};
}

std::string test_name(std::string_view law, int exponent) {
  std::string name(law);
  std::replace_if(
      name.begin(), name.end(), [](unsigned char letter) { return !std::isalnum(letter); }, '_');
  return exponent == 1 ? name + "_exponent_1" : name;
}

}  // namespace

LawCase law_case(std::string_view law, const std::vector<std::string>& overrides) {
  return made(test_name(law, 0), law, overrides);
}

LawCase with_recruitment(const LawCase& law, const std::string& recruitment, double sharpness) {
  std::vector<std::string> overrides{"wall.exponent=" + std::to_string(law.exponent),
                                     "wall.recruitment=" + recruitment};
  if (recruitment == "smooth") overrides.push_back("wall.sharpness=" + std::to_string(sharpness));
  return made(law.name, law.entry->name, overrides);
}

std::vector<LawCase> law_cases() {
  std::vector<LawCase> cases;
  for (const wall::LawEntry& entry : wall::laws()) {
    if (!entry.has_fibers) cases.push_back(made(test_name(entry.name, 0), entry.name, {}));
    for (const int exponent : {2, 1})
      if (entry.has_fibers)
        cases.push_back(
            made(test_name(entry.name, exponent), entry.name, {"wall.exponent=" + std::to_string(exponent)}));
  }
  return cases;
}

std::vector<LawCase> fiber_law_cases() {
  std::vector<LawCase> cases = law_cases();
  std::erase_if(cases, [](const LawCase& law) { return !law.entry->has_fibers; });
  return cases;
}

std::vector<LawCase> isotropic_law_cases() {
  std::vector<LawCase> cases = law_cases();
  std::erase_if(cases, [](const LawCase& law) { return law.entry->has_fibers; });
  return cases;
}

wall::Law<double> without_fibers(const wall::Law<double>& law) {
  return std::visit(
      [](auto l) -> wall::Law<double> {
        if constexpr (wall::HasFamilies<decltype(l)>) l.families.clear();
        return l;
      },
      law);
}

double distance_to_recruitment(const LawCase& law, const Tensor<double>& displacement_gradient,
                               const wall::MaterialAxes& axes) {
  double distance = 1;
  for (std::size_t k = 0; k < law.reference.families.size(); ++k) {
    const Real excess = law.reference.excess(k, deformation_gradient(displacement_gradient), axes);
    distance = std::min(distance, static_cast<double>(std::abs(excess)));
  }
  return distance;
}

bool fully_recruited(const LawCase& law, const Tensor<double>& displacement_gradient,
                     const wall::MaterialAxes& axes) {
  for (std::size_t k = 0; k < law.reference.families.size(); ++k)
    if (law.reference.excess(k, deformation_gradient(displacement_gradient), axes) <= 0) return false;
  return true;
}

double stress_scale(const wall::Law<double>& law, const Tensor<double>& displacement_gradient,
                    const wall::MaterialAxes& axes) {
  double most = 0;
  for (const auto& row : wall::stress_and_tangent(law, displacement_gradient, axes).tangent)
    for (const double entry : row) most = std::max(most, std::abs(entry));
  return most;
}

}  // namespace tunica::test_support
