// SPDX-License-Identifier: GPL-3.0-or-later
// Static states of the clamped tube: against the thick ring, which is exact away from the ends, and blood in
// steady flow against Poiseuille.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/radial/from_scene.hpp"
#include "core/radial/wall_curve.hpp"
#include "tests/support/axisym_runs.hpp"

namespace tunica {
namespace {

using test_support::artery;
using test_support::run_axisym;
using test_support::values;

const std::vector<double> places{0, 1.0 / 3, 2.0 / 3, 1};  // of P1 to P4 in the wall

/// Displacements of P1 to P4 in a ring under the scene's pressure.
std::vector<double> ring_displacements(const Scene& scene) {
  const radial::WallCurve curve(radial::ring_model(scene, {}), {0.0});
  const double stretch = curve.stretch_at(scene.number("inlet.pressure"));
  std::vector<double> displacements;
  for (const auto& state : curve.model().respond(stretch, places, false).states)
    displacements.push_back(state.displacement);
  return displacements;
}

/// Cells with which the lumen is right to 1e-5, wherever in the wall fibres begin to be recruited: the stress
/// has a kink there, which moves within a cell.
const std::vector<std::string> fine{"mesh.wall_cells=16", "mesh.blood_cells=4", "mesh.axial_cells=40"};

std::vector<std::string> joined(std::vector<std::string> first, const std::vector<std::string>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

Scene static_tube(const std::string& law, const std::string& pressure, std::vector<std::string> more = {}) {
  more.insert(more.end(),
              {"wall.law=" + law, "inlet.pressure=" + pressure + " mmHg", "output.field_interval=0"});
  return read_scene(std::string(TUNICA_SOURCE_DIR) + "/scenes/static_tube.toml", more);
}

/// Relative differences between tube and ring at P1 to P4.
std::vector<double> differences(const Scene& scene, const Result& result) {
  std::vector<double> all = ring_displacements(scene);
  for (std::size_t p = 0; p < all.size(); ++p)
    all[p] = values(result.observables, fmt::format("radial_displacement.P{}", p + 1)).at(0) / all[p] - 1;
  return all;
}
double greatest_difference(const Scene& scene, const Result& result) {
  double greatest = 0;
  for (const double difference : differences(scene, result))
    greatest = std::max(greatest, std::abs(difference));
  return greatest;
}

struct Case {
  std::string law, pressure;
};
class StaticTube : public testing::TestWithParam<Case> {};

// The bar is 1e-5 for the lumen. Half of it is left for a front of recruitment within a cell. The ends of the
// ZS wall, stiff along the artery, are felt at mid-length: by 9e-6 in the lumen and 4e-5 on the outside at
// 130 mmHg.
TEST_P(StaticTube, IsTheRingAtMidLength) {
  const Scene scene = static_tube(GetParam().law, GetParam().pressure, fine);
  const Result result = run_axisym(scene);
  EXPECT_EQ(result.record.rejected_steps, 0);
  EXPECT_LT(std::abs(differences(scene, result).front()), 1e-5);
  EXPECT_LT(greatest_difference(scene, result), GetParam().law == "EXP1+EXP2-ZS" ? 5e-5 : 1e-5);
  // The whole wall is stable, its corners included, as the strip is with this tether.
  EXPECT_EQ(result.record.resolution.at("negative_pivots"), 0);
  // The ends are held.
  const auto& along = values(result.along, "radial_displacement");
  EXPECT_EQ(along.front(), 0);
  EXPECT_EQ(along.back(), 0);
}

// What a scene asks for without a word about cells: 1 % of the displacement.
TEST_P(StaticTube, KeepsItsToleranceWithTheCellsThatItChooses) {
  const Scene scene = static_tube(GetParam().law, GetParam().pressure);
  EXPECT_LT(greatest_difference(scene, run_axisym(scene)), scene.number("accuracy.tolerance"));
}

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const char* law : {"EXP1", "EXP2", "EXP1+EXP2-ZS", "EXP1+EXP2-FS"})
    for (const char* pressure : {"100", "130"}) cases.push_back({law, pressure});
  return cases;
}
INSTANTIATE_TEST_SUITE_P(, StaticTube, testing::ValuesIn(all_cases()), [](const auto& instance) {
  std::string name = instance.param.law + "At" + instance.param.pressure;
  std::erase_if(name, [](char c) { return c == '+' || c == '-'; });
  return name;
});

// With a third more length each side's end is 0.11 cm further away, 2.7 of the lengths over which it is felt.
TEST(StaticTubeEnds, AreFeltLessInALongerTube) {
  const Scene shorter = static_tube("EXP1+EXP2-ZS", "130", fine);
  const Scene longer = static_tube("EXP1+EXP2-ZS", "130", joined(fine, {"geometry.length=0.88"}));
  const double felt = greatest_difference(shorter, run_axisym(shorter));
  EXPECT_GT(felt, 1e-5);
  EXPECT_LT(greatest_difference(longer, run_axisym(longer)), 0.1 * felt);
}

// Without clamps there is nothing but the ring: what is left is the mesh, 16 quadratic cells through the
// wall, and within one of them the front of recruitment.
TEST(StaticTubeEnds, ThatSlideLeaveTheRing) {
  for (const char* pressure : {"90", "108", "122", "150"}) {
    const Scene scene = static_tube("EXP1+EXP2-FS", pressure,
                                    {"geometry.ends=sliding", "mesh.wall_cells=16", "mesh.axial_cells=2"});
    EXPECT_LT(greatest_difference(scene, run_axisym(scene)), 1e-5) << pressure;
  }
}

// A hundredth of the radius is the least that a scene may have.
TEST(StaticTubeEnds, ThatSlideLeaveTheThinnestRing) {
  for (const char* law : {"EXP1", "EXP1+EXP2-FS"}) {
    const Scene scene =
        static_tube(law, "100", {"geometry.ends=sliding", "mesh.axial_cells=2", "geometry.thickness=3.3e-4"});
    EXPECT_LT(greatest_difference(scene, run_axisym(scene)), 1e-5) << law;
  }
}

// Linear elements are of second order in the displacement, the wall's pressure interpolated on its own or
// not.
TEST(StaticTubeElements, ConvergeToTheRing) {
  const auto error = [](const char* element, const char* wall_cells, const char* axial_cells) {
    const Scene scene = static_tube("EXP1", "100",
                                    {element, std::string("mesh.wall_cells=") + wall_cells,
                                     std::string("mesh.axial_cells=") + axial_cells});
    return greatest_difference(scene, run_axisym(scene));
  };
  for (const char* element : {"mesh.element=linear", "mesh.element=bubble"})
    EXPECT_NEAR(std::log2(error(element, "6", "24") / error(element, "12", "48")), 2, 0.15) << element;
  // Quadratic triangles, and the wall's pressure at each point: a few cells will do.
  EXPECT_LT(error("mesh.cell=triangle", "4", "24"), 1e-4);
  EXPECT_LT(error("mesh.mixed_wall=false", "4", "24"), 1e-5);
}

/// Poiseuille's stress on the wall of a tube of radius a, dyn/cm2, and pressure gradient.
double shear_stress(double viscosity, double flow, double a) {
  return 4 * viscosity * flow / (std::numbers::pi * a * a * a);
}
double gradient(double viscosity, double flow, double a) {
  return 2 * shear_stress(viscosity, flow, a) / a;
}

struct SteadyTube {
  std::vector<double> z, radius, pressure, stress;
  std::size_t low, middle, high;  ///< rows at a quarter, half and three quarters of the length

  explicit SteadyTube(const Result& result)
      : z(values(result.along, "z")),
        radius(values(result.along, "lumen_radius")),
        pressure(values(result.along, "pressure")),
        stress(values(result.along, "wall_shear_stress")),
        low(z.size() / 4),
        middle(z.size() / 2),
        high(3 * z.size() / 4) {}
  double mean_gradient() const { return (pressure[low] - pressure[high]) / (z[high] - z[low]); }
};

constexpr double viscosity = 0.035;
/// A section of a longer artery, into which the flow comes developed.
const std::vector<std::string> sliding =
    joined(fine, {"wall.law=EXP1", "inlet.waveform=constant", "inlet.profile=natural",
                  "inlet.pressure_kind=static", "geometry.ends=sliding", "time.mode=static"});
/// A hundredth of the flow through a hundred times the resistance: blood without inertia, under the same
/// pressure.
constexpr double creeping = 1.217e-3;
const std::vector<std::string> creeps{"inlet.flow=1.217e-3", "outlet.resistance=1.032e8"};

// A tube whose ends slide is a cylinder, but for the taper by its own loss of pressure. With so little flow
// that taper is 1e-7 of the radius.
TEST(SteadyFlow, IsPoiseuillesInTheDeformedTube) {
  const Scene scene = artery(joined(sliding, creeps));
  const Result result = run_axisym(scene);
  EXPECT_EQ(result.record.rejected_steps, 0);
  EXPECT_NEAR(values(result.observables, "inflow").at(0) / creeping, 1, 1e-9);
  EXPECT_NEAR(values(result.observables, "outflow").at(0) / creeping, 1, 1e-9);
  EXPECT_NEAR(values(result.observables, "outlet_pressure").at(0) / (1.032e8 * creeping), 1, 1e-9);
  const SteadyTube tube(result);
  const double radius = tube.radius[tube.middle];
  EXPECT_NEAR(tube.stress[tube.middle] / shear_stress(viscosity, creeping, radius), 1, 1e-6);
  EXPECT_NEAR(tube.mean_gradient() / gradient(viscosity, creeping, radius), 1, 1e-6);
  // The ring carries the pressure of its own place.
  const radial::WallCurve curve(radial::ring_model(scene, {}), {0.0});
  EXPECT_NEAR(radius / (0.033 * curve.stretch_at(tube.pressure[tube.middle])), 1, 1e-6);
}

// At the paper's flow the radius falls by s = 4e-4 per cm of length, and blood is accelerated. Its inertia
// is of the order Re a s = 90 x 0.047 cm x 4e-4/cm = 2e-3 beside viscosity.
TEST(SteadyFlow, FeelsItsInertiaInTheTaperOfItsOwnLoss) {
  const Scene scene = artery(sliding);
  const SteadyTube tube(run_axisym(scene));
  const double flow = scene.number("inlet.flow"), radius = tube.radius[tube.middle];
  EXPECT_NEAR(tube.stress[tube.middle] / shear_stress(viscosity, flow, radius), 1, 2e-3);
  EXPECT_NEAR(tube.mean_gradient() / gradient(viscosity, flow, radius), 1, 5e-3);
}

// Clamped ends narrow the lumen over a few hundredths of a cm. Away from them the flow is Poiseuille's.
TEST(SteadyFlow, IsPoiseuillesAwayFromClampedEnds) {
  const Scene scene = artery(joined(joined(fine, {"inlet.waveform=constant", "time.mode=static"}), creeps));
  const Result result = run_axisym(scene);
  EXPECT_EQ(result.record.rejected_steps, 0);
  const SteadyTube tube(result);
  for (std::size_t k = 0; k < tube.z.size(); ++k) {
    if (tube.z[k] < 0.1 || tube.z[k] > tube.z.back() - 0.1) continue;
    EXPECT_NEAR(tube.stress[k] / shear_stress(viscosity, creeping, tube.radius[k]), 1, 1e-3) << tube.z[k];
  }
  EXPECT_NEAR(tube.stress[tube.middle] / shear_stress(viscosity, creeping, tube.radius[tube.middle]), 1,
              1e-5);
}

}  // namespace
}  // namespace tunica
