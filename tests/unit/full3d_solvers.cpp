// SPDX-License-Identifier: GPL-3.0-or-later
// Linear systems in space: every method finds the same state; options and memory are looked at before work.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/coupled/newton.hpp"
#include "core/error.hpp"
#include "full3d/assembler.hpp"
#include "full3d/memory.hpp"
#include "full3d/option_check.hpp"
#include "full3d/setup.hpp"
#include "full3d/solver_options.hpp"

namespace tunica::full3d {
namespace {

const char* const vessel = R"(
[geometry]
radius = 0.033
thickness = 0.01
length = 0.2
GEOMETRY
[wall]
law = "EXP1+EXP2-FS"
bulk_modulus = 9e6
[tether]
stiffness = 1e7
traction = "normal"
[inlet]
waveform = "ica"
[outlet]
kind = "resistance"
resistance = 1.032e6
[mesh]
wall_cells = 2
blood_cells = 1
axial_cells = 4
around_cells = 8
motion = "harmonic"
)";

std::unique_ptr<Setup> setup_with(const std::string& geometry) {
  std::string text = vessel;
  text.replace(text.find("GEOMETRY"), 8, geometry);
  static std::vector<std::unique_ptr<Scene>> scenes;
  scenes.push_back(std::make_unique<Scene>(parse_scene(text, "small", ".")));
  return setup_of(*scenes.back());
}

struct Solved {
  std::vector<double> y;
  bool converged;
  long linear_iterations, newton_iterations;
};

/// A step of backward Euler from rest.
Solved step(const Setup& setup, const std::string& method) {
  const Ranks ranks;
  const Assembler assembler(setup.problem, ranks, {method, ""});
  coupled::Newton newton(assembler);
  Solved solved{std::vector<double>(assembler.layout().size(), 0.0), false, 0, 0};
  solved.converged = newton.solve({5e-3, 200, {}}, solved.y, {1e-9, 60}).converged;
  solved.linear_iterations = newton.counts().linear_iterations;
  solved.newton_iterations = newton.counts().iterations;
  return solved;
}

class Methods : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Full3d, Methods, testing::Values("schwarz", "block"),
                         [](const auto& test) { return test.param; });

// Newton ends at 1e-9 of each field; 1e-6 leaves room for the greatest error of single entries.
TEST_P(Methods, FindTheStateThatFactorsFind) {
  for (const char* geometry : {"kind = \"cylinder\"", "kind = \"torus\"\nbend_angle = 60"}) {
    SCOPED_TRACE(geometry);
    const auto setup = setup_with(geometry);
    const Layout layout = layout_of(setup->problem);
    const Solved direct = step(*setup, "direct"), krylov = step(*setup, GetParam());
    ASSERT_TRUE(direct.converged);
    ASSERT_TRUE(krylov.converged);
    EXPECT_GT(krylov.linear_iterations, 2 * krylov.newton_iterations);
    const std::size_t ends[] = {0, layout.velocity_begin(), layout.pressure_begin(), layout.size()};
    for (int field = 0; field < 3; ++field) {
      double size = 0, difference = 0;
      for (std::size_t e = ends[field]; e < ends[field + 1]; ++e) {
        size = std::max(size, std::abs(direct.y[e]));
        difference = std::max(difference, std::abs(krylov.y[e] - direct.y[e]));
      }
      EXPECT_GT(size, 0);
      EXPECT_LT(difference, 1e-6 * size) << "field " << field;
    }
  }
}

TEST(full3d, OptionsOfSolversAreRefusedByWord) {
  EXPECT_NO_THROW(check_options({"block", ""}));
  EXPECT_NO_THROW(check_options({"block", "-ksp_rtol 1e-8 -ksp_monitor -ksp_divtol -1"}));
  for (const char* options : {"ksp_rtol 1e-8", "-ksp_rtol 1e-8 7", "1e-8"}) try {
      check_options({"block", options});
      ADD_FAILURE() << options;
    } catch (const InvalidInput& refusal) {
      EXPECT_NE(std::string(refusal.what()).find(options), std::string::npos) << refusal.what();
    }
}

std::string refusal_of(const SolverChoice& choice, bool with_blood = true, bool lagged = false) {
  // What a choice has put into PETSc's database stays for the process.
  check(PetscOptionsClear(nullptr), "PetscOptionsClear");
  try {
    check_options(choice);
    try_options(choice, with_blood, lagged);
  } catch (const InvalidInput& refusal) {
    const std::string message = refusal.what();
    EXPECT_NE(message.find("solver.options = \"" + choice.options + "\""), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return message;
  }
  return "";
}

/// Options below the top level of each method: none of them is asked for before its part is set up.
TEST(full3d, OptionsOfPartsAreRefusedBeforeWork) {
  struct Case {
    SolverChoice choice;
    const char* word;
    bool with_blood = true, lagged = false;
  };
  const std::string velocity = "-fieldsplit_motion_fieldsplit_velocity_";
  const std::string petsc = "-sub_pc_factor_mat_solver_type petsc";
  for (const Case& bad : {
           Case{{"schwarz", "-sub_pc_type ILU"}, "did you mean ilu?"},
           Case{{"schwarz", "-sub_ksp_type gmress"}, "did you mean gmres?"},
           Case{{"schwarz", "-sub_pc_factor_mat_solver_type mump"}, "did you mean mumps?"},
           Case{{"schwarz", "-sub_pc_factor_mat_ordering_type ndd"}, "did you mean nd?"},
           Case{{"schwarz", "-sub_pc_type nonsense"}, "but "},
           Case{{"schwarz", "-sub_pc_factor_mat_solver_type superlu_dist"}, "write umfpack"},
           Case{{"block", velocity + "sub_pc_factor_mat_solver_type superlu_dist"}, "write umfpack"},
           Case{{"block", velocity + "sub_pc_type ILU"}, "did you mean ilu?"},
           Case{{"block", "-fieldsplit_pressure_pc_type ILU"}, "did you mean ilu?"},
           // Of these the values are no names of a list.
           Case{{"schwarz", "-sub_pc_factor_shift_type nonsense"}, "PETSc refuses them"},
           Case{{"schwarz", "-sub_pc_type ilu -sub_pc_factor_levels many " + petsc}, "PETSc refuses them"},
           Case{{"block", "-pc_fieldsplit_schur_fact_type most"}, "PETSc refuses them"},
           Case{{"block", velocity + "sub_pc_factor_shift_type nonsense"}, "PETSc refuses them"},
           Case{{"block", "-fieldsplit_motion_sub_pc_factor_shift_type nonsense"},
                "PETSc refuses them",
                true,
                true},
           Case{{"schwarz", "-sub_pc_factor_shift_type nonsense"}, "PETSc refuses them", false},
       }) {
    const std::string message = refusal_of(bad.choice, bad.with_blood, bad.lagged);
    EXPECT_NE(message.find(bad.word), std::string::npos) << bad.choice.options << ": " << message;
  }
  for (const Case& good : {Case{{"direct", "-pc_factor_mat_solver_type umfpack"}, ""},
                           Case{{"schwarz", "-sub_pc_type ilu -sub_pc_factor_levels 1 " + petsc}, ""},
                           Case{{"schwarz", "-sub_pc_factor_mat_solver_type superlu"}, ""},
                           Case{{"block", velocity + "sub_pc_type ilu " +
                                              "-fieldsplit_motion_fieldsplit_velocity_" + petsc.substr(1)},
                                ""},
                           Case{{"block", "-ksp_rtol 1e-8"}, "", true, true},
                           Case{{"schwarz", "-sub_pc_type ilu " + petsc}, "", false}})
    EXPECT_EQ(refusal_of(good.choice, good.with_blood, good.lagged), "") << good.choice.options;
}

TEST(full3d, MethodsAreChosenBySize) {
  EXPECT_EQ(method_for("auto", 300000), "direct");
  EXPECT_EQ(method_for("auto", 300001), "block");
  EXPECT_EQ(method_for("schwarz", 10), "schwarz");
}

TEST(full3d, ScenesTooLargeForMemoryAreRefusedWithWhatFits) {
  const int unknowns = 1000000;
  const double direct = estimated_memory("direct", unknowns), block = estimated_memory("block", unknowns);
  ASSERT_LT(2 * block, direct);
  const auto message = [&](double available) -> std::string {
    try {
      check_memory("direct", unknowns, available);
    } catch (const InvalidInput& refusal) {
      return refusal.what();
    }
    return "";
  };
  EXPECT_EQ(message(1.01 * direct), "");
  EXPECT_NE(message(0.99 * direct).find("solver.method = \"block\""), std::string::npos);
  EXPECT_EQ(message(0.99 * block).find("\"block\""), std::string::npos);
  EXPECT_NE(message(0.99 * block).find("mesh.*_cells"), std::string::npos);
  EXPECT_NO_THROW(check_memory("direct", unknowns, {}));
}

}  // namespace
}  // namespace tunica::full3d
