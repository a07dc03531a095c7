// SPDX-License-Identifier: GPL-3.0-or-later
// Vessels from Gmsh files in the 3D tier: those that it can also mesh itself, and one that the 2D tier reads.
#include <cmath>
#include <fstream>
#include <random>

#include "axisym/axisym_tier.hpp"
#include "core/error.hpp"
#include "tests/support/full3d_runs.hpp"
#include "tests/support/solid_gmsh.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tunica {
namespace {

namespace fs = std::filesystem;
using test_support::difference;
using test_support::greatest;
using test_support::joined;
using test_support::range;
using test_support::run_full3d;
using test_support::short_flow;
using Settings = std::vector<std::string>;

const fs::path scenes = fs::path(TUNICA_SOURCE_DIR) / "scenes";
const Settings few_steps = joined(short_flow, {{"time.step=0.02", "output.interval=0.02"}});

/// A scene in a folder whose mesh is the one that another scene has.
class FromFile : public testing::Test {
 protected:
  void write(const full3d::Mesh& mesh) const {
    std::ofstream(folder_.path() / "artery.msh") << test_support::gmsh_model(mesh).text("4.1");
  }
  Scene scene(const std::string& text, const Settings& settings) const {
    const fs::path file = folder_.path() / "artery.toml";
    std::ofstream(file) << "[geometry]\nkind = \"mesh\"\nfile = \"artery.msh\"\n" << text;
    return read_scene(file, settings);
  }
  const test_support::TemporaryFolder folder_;
};

const std::vector<double>& values(const Result& result, const std::string& column) {
  return result.observables.find(column)->values;
}

/// Greatest difference of a column, by its range.
double off(const Result& a, const Result& b, const std::string& column) {
  return difference(values(a, column), values(b, column)) / range(values(b, column));
}

/// The message that refuses a scene before anything is computed.
std::string refused(const Scene& scene) {
  const full3d::Ranks ranks;
  full3d::Team team(ranks);
  try {
    full3d::Full3dTier(team).prepare(scene);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "not refused";
}

TEST_F(FromFile, ATorusIsTheBuiltInOne) {
  const Settings own = joined(
      few_steps, {{"geometry.length=0.22", "geometry.bend_angle=60", "mesh.wall_cells=2",
                   "mesh.blood_cells=1", "mesh.axial_cells=8", "mesh.around_cells=8", "mesh.symmetry=full"}});
  const Scene torus = read_scene(scenes / "torus.toml", own);
  write(full3d::o_grid_vessel(full3d::vessel_spec(torus, full3d::resolution(torus), true)));
  const Result built = run_full3d(torus);
  const Result found =
      run_full3d(scene("[wall]\nlaw = \"EXP1+EXP2-FS\"\n[tether]\nstiffness = 1e7\n", few_steps));
  ASSERT_EQ(found.observables.columns().size(), built.observables.columns().size());
  // The very same cells; axes differ by the error of harmonic functions on them.
  for (const char* column : {"inflow", "outflow", "pressure", "outlet_pressure"})
    EXPECT_LT(off(found, built, column), 1e-4) << column;
  EXPECT_LT(off(found, built, "transmural_pressure"), 3e-3);
  for (const char* angle : {"", ".90deg", ".180deg", ".270deg"})
    for (const char* point : {"P1", "P2", "P3", "P4"}) {
      EXPECT_LT(off(found, built, std::string("radial_displacement.") + point + angle), 1e-3)
          << point << angle;
      // On faces between cells, which stress jumps across, points lie on the one side or on the other.
      EXPECT_LT(off(found, built, std::string("von_mises.") + point + angle), 1e-2) << point << angle;
    }
}

TEST_F(FromFile, AWallAloneIsTheBuiltInOne) {
  const Settings loads{"time.mode=static", "inlet.waveform=pressure", "inlet.pressure=60 mmHg"};
  const Settings own = joined(loads, {{"geometry.length=0.3", "mesh.wall_cells=2", "mesh.axial_cells=6",
                                       "mesh.around_cells=16", "mesh.symmetry=full"}});
  const Scene cylinder = read_scene(scenes / "cylinder.toml", own);
  auto spec = full3d::vessel_spec(cylinder, full3d::resolution(cylinder), true);
  const Result built = run_full3d(cylinder);
  for (const bool blood : {true, false}) {
    spec.blood = blood;
    write(full3d::o_grid_vessel(spec));
    const Result found = run_full3d(scene("", loads));
    for (const char* point : {"P1", "P4"}) {
      const std::string column = std::string("radial_displacement.") + point;
      EXPECT_NEAR(values(found, column).back(), values(built, column).back(),
                  1e-3 * greatest(values(built, column)))
          << blood;
    }
  }
}

// The mesh in space of what scenes/stenosis.msh is the half plane of, but for cells and coordinates.
TEST_F(FromFile, ANarrowedArteryIsThatOfTheHalfPlane) {
  full3d::VesselSpec spec;
  spec.radius = 0.033;
  spec.layers = {0.01};
  spec.length = 0.66;
  spec.around_cells = 8;
  spec.ring_cells = spec.wall_cells = 2;
  spec.axial_cells = 20;
  full3d::Mesh mesh = full3d::o_grid_vessel(spec);
  const test_support::Stenosis shape;
  for (full3d::Point& x : mesh.points) {
    // Cells are shortest in the middle.
    const double s = 2 * x[2] / shape.length - 1;
    x[2] = 0.5 * shape.length * (1 + 0.45 * s + 0.55 * s * s * s);
    const double r = std::hypot(x[0], x[1]), lumen = shape.lumen(x[2]),
                 outer = shape.radius + shape.thickness;
    if (r == 0) continue;
    const double moved = r <= shape.radius * (1 + 1e-9)
                             ? r * lumen / shape.radius
                             : lumen + (outer - lumen) * (r - shape.radius) / shape.thickness;
    x[0] *= moved / r;
    x[1] *= moved / r;
  }
  write(mesh);
  const Result space = run_full3d(scene("[wall]\nlaw = \"EXP1\"\n", few_steps));
  const Scene plane = read_scene(scenes / "stenosis.toml", few_steps);
  const Result half = axisym::AxisymTier().prepare(plane)->execute({});
  // Ten cells in the narrow half and eight around; the error of pressures falls with the fourth order, that
  // of stresses at the surfaces with the second.
  for (const char* column : {"outflow", "pressure", "outlet_pressure"})
    EXPECT_LT(off(space, half, column), 5e-3) << column;
  EXPECT_LT(off(space, half, "transmural_pressure"), 1e-2);
  for (const char* point : {"P1", "P2", "P3", "P4"})
    EXPECT_LT(off(space, half, std::string("radial_displacement.") + point), 1.5e-2) << point;
  for (const char* point : {"P1", "P2", "P3"})
    EXPECT_LT(off(space, half, std::string("von_mises.") + point), 3e-2) << point;
}

// What meshers leave of a plane plays no part where a pressure drives a wall alone that is clamped.
TEST_F(FromFile, UnevenEndsChangeNothingThatIsClamped) {
  const Settings loads{"time.mode=static", "inlet.waveform=pressure", "inlet.pressure=20 mmHg",
                       "output.field_interval=0"};
  full3d::VesselSpec spec;
  spec.radius = 0.033;
  spec.layers = {0.01};
  spec.length = 0.2;
  spec.around_cells = 8;
  spec.ring_cells = spec.wall_cells = 1;
  spec.axial_cells = 4;
  spec.shape = full3d::Shape::tetrahedron;
  full3d::Mesh mesh = full3d::o_grid_vessel(spec);
  const std::string law = "[wall]\nlaw = \"neo-Hookean\"\n";
  write(mesh);
  const Result even = run_full3d(scene(law, loads));
  std::mt19937 random(14);
  std::uniform_real_distribution<double> noise(-3.5e-4, 3.5e-4);
  for (full3d::Point& x : mesh.points)
    if (x[2] == 0 || x[2] > spec.length - 1e-9) x[2] += noise(random);
  write(mesh);
  const Result uneven = run_full3d(scene(law, loads));
  for (const char* point : {"P1", "P4"}) {
    const std::string column = std::string("radial_displacement.") + point;
    EXPECT_NEAR(values(uneven, column).back() / values(even, column).back(), 1, 1e-2) << column;
  }
  // Ends that slide do so in their plane.
  EXPECT_TRUE(refused(scene(law, joined(loads, {{"geometry.ends=sliding"}}))).find("draw it flat") !=
              std::string::npos);
}

// The same tube from a file and turned on its side, far from the origin: free of the same shifts and turn.
TEST_F(FromFile, ATubeOnRollersIsNeutralAndNotUnstable) {
  full3d::VesselSpec spec;
  spec.radius = 0.1;
  spec.layers = {0.03};
  spec.length = 0.4;
  spec.around_cells = 8;
  spec.ring_cells = spec.wall_cells = 1;
  spec.axial_cells = 2;
  spec.shape = full3d::Shape::tetrahedron;
  full3d::Mesh mesh = full3d::o_grid_vessel(spec);
  for (full3d::Point& x : mesh.points) x = {x[2] + 7, x[0] - 3, x[1] + 5};
  write(mesh);
  const Result result =
      run_full3d(scene("[wall]\nlaw = \"St-Venant-Kirchhoff\"\nyoung_modulus = 1e7\npoisson_ratio = "
                       "0.3\n[tether]\nstiffness = 0\n",
                       {"time.mode=static", "inlet.waveform=pressure", "inlet.pressure=1e4",
                        "geometry.ends=sliding", "geometry.radius=0.1", "output.field_interval=0"}));
  EXPECT_EQ(result.record.resolution.at("neutral_motions"), 3);
  EXPECT_EQ(result.record.resolution.at("negative_pivots"), 0);
  EXPECT_TRUE(result.record.findings.empty());
}

// A sac that leaves its artery in a sharp neck: cells in the crease have all of their corners on the outer
// surface, and no direction across the wall.
TEST(SharpNeck, IsComputedWithoutFibersAndRefusedWith) {
  const fs::path file = fs::path(TUNICA_SOURCE_DIR) / "tests" / "meshes" / "sharp_neck.msh";
  const auto neck = [&](const Settings& more) {
    return parse_scene("[geometry]\nkind = \"mesh\"\nradius = 0.2\n[time]\nmode = \"static\"\n", "neck", ".",
                       joined(more, {{"geometry.file=" + file.string(), "inlet.waveform=pressure",
                                      "inlet.pressure=1 mmHg", "mesh.element=linear"}}));
  };
  const Result found = run_full3d(neck({"wall.law=neo-Hookean"}));
  for (const char* point : {"P1", "P2", "P3", "P4"}) {
    // At mid-length, on the side of the sac and on the other.
    for (const char* angle : {"", ".180deg"}) {
      const std::string at = std::string(point) + angle;
      EXPECT_TRUE(std::isfinite(values(found, "radial_displacement." + at).back())) << at;
      EXPECT_GT(values(found, "von_mises." + at).back(), 0) << at;
    }
    EXPECT_TRUE(std::isnan(values(found, std::string("fiber_angle.") + point).back()));
  }
  EXPECT_NE(refused(neck({"wall.law=EXP1+EXP2-FS"})).find("write mesh.element = \"quadratic\""),
            std::string::npos);
}

}  // namespace
}  // namespace tunica
