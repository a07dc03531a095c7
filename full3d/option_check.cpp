// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/option_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <string_view>

#include "core/error.hpp"
#include "core/scene/message.hpp"
#include "full3d/assembler.hpp"
#include "full3d/setup.hpp"
#include "full3d/solver_options.hpp"

namespace tunica::full3d {

namespace {

/// A name of an option, not a negative number.
bool is_option(const std::string& word) {
  return word.size() > 1 && word[0] == '-' && std::isalpha(static_cast<unsigned char>(word[1]));
}

std::vector<std::string> names_in(PetscFunctionList list) {
  const char** names = nullptr;
  int count = 0;
  check(PetscFunctionListGet(list, &names, &count), "PetscFunctionListGet");
  // The count includes a null at the end.
  std::vector<std::string> all;
  for (int k = 0; k < count; ++k)
    if (names[k]) all.emplace_back(names[k]);
  check(PetscFree(names), "PetscFree");
  std::sort(all.begin(), all.end());
  return all;
}

/// Packages of factors that this PETSc has been built with.
std::vector<std::string> packages() {
  std::vector<std::string> all;
  for (const char* name : {MATSOLVERPETSC, MATSOLVERMUMPS, MATSOLVERUMFPACK, MATSOLVERKLU, MATSOLVERSUPERLU,
                           MATSOLVERSUPERLU_DIST, MATSOLVERCHOLMOD, MATSOLVERSPQR, MATSOLVERSTRUMPACK,
                           MATSOLVERPASTIX, MATSOLVERMKL_PARDISO, MATSOLVERMKL_CPARDISO, MATSOLVERLUSOL}) {
    PetscBool has_package = PETSC_FALSE, has_type = PETSC_FALSE;
    MatSolverFunction make = nullptr;
    check(MatSolverTypeGet(name, MATSEQAIJ, MAT_FACTOR_LU, &has_package, &has_type, &make),
          "MatSolverTypeGet");
    if (has_package == PETSC_TRUE) all.emplace_back(name);
  }
  return all;
}

/// What the end of an option's name says that its value is one of.
struct Kind {
  std::string_view ending, what;
  std::vector<std::string> names;
};

std::vector<Kind> kinds() {
  // The lists are filled when something of theirs is first made.
  OwnedSolver solver;
  check(KSPCreate(PETSC_COMM_SELF, solver.put()), "KSPCreate");
  PC pc = nullptr;
  check(KSPGetPC(solver.get(), &pc), "KSPGetPC");
  return {{"pc_type", "preconditioner", names_in(PCList)},
          {"ksp_type", "solver", names_in(KSPList)},
          {"pc_factor_mat_solver_type", "package of factors", packages()},
          {"pc_factor_mat_ordering_type", "ordering", names_in(MatOrderingList)}};
}

[[noreturn]] void refuse(const SolverChoice& choice, const std::string& why) {
  throw InvalidInput(fmt::format("solver.options = \"{}\": {}", choice.options, why));
}

void check_value(const SolverChoice& choice, const std::vector<Kind>& known, const std::string& option,
                 const std::string& value) {
  // "-pc_type" and, with a prefix, "-sub_pc_type".
  const auto ends_with = [&](std::string_view ending) {
    const std::string_view name = std::string_view(option).substr(1);
    return name.ends_with(ending) &&
           (name.size() == ending.size() || name[name.size() - ending.size() - 1] == '_');
  };
  for (const auto& [ending, what, names] : known) {
    if (!ends_with(ending) || std::find(names.begin(), names.end(), value) != names.end()) continue;
    const std::string near = scene::nearest(value, names);
    refuse(choice, fmt::format("PETSc refuses {} {}, here or in PETSC_OPTIONS: it has no {} of that name{}",
                               option, value, what,
                               near.empty() ? fmt::format(", but {}", fmt::join(names, ", "))
                                            : scene::did_you_mean(near)));
  }
  // Several of its factors in one process share what is made once in a process.
  const bool of_parts = option.starts_with("-sub_") || option.find("_sub_") != std::string::npos;
  if (of_parts && ends_with("pc_factor_mat_solver_type") && value == MATSOLVERSUPERLU_DIST)
    refuse(choice,
           fmt::format("{} {}, here or in PETSC_OPTIONS: superlu_dist spoils the memory of the program "
                       "when it factorises parts; write umfpack, mumps or superlu",
                       option, value));
}

/// Without what prints: nobody has asked for the course of a trial.
std::string silent(const std::string& options) {
  std::string kept;
  bool is_left_out = false;
  for (const std::string& word : words_in(options)) {
    if (is_option(word))
      is_left_out = word.find("monitor") != std::string::npos || word.find("view") != std::string::npos ||
                    word.find("reason") != std::string::npos;
    if (!is_left_out) kept += word + ' ';
  }
  return kept;
}

constexpr const char* small_vessel = R"(
[geometry]
length = 0.1
[mesh]
element = "linear"
wall_cells = 1
blood_cells = 1
axial_cells = 4
around_cells = 8
)";
constexpr const char* without_blood = R"(
[time]
mode = "static"
[inlet]
waveform = "pressure"
)";

}  // namespace

void check_options(const SolverChoice& choice) {
  bool name_before = false;
  for (const std::string& word : words_in(choice.options)) {
    const bool is_name = is_option(word);
    if (!is_name && !name_before)
      throw InvalidInput(
          fmt::format("solver.options = \"{}\" is not a list of PETSc options, such as \"-ksp_rtol 1e-8\": "
                      "\"{}\" follows no option",
                      choice.options, word));
    name_before = is_name;
  }
  const auto words = words_in(given_options(choice));
  if (words.empty()) return;
  const auto known = kinds();
  for (std::size_t k = 0; k + 1 < words.size(); ++k)
    if (is_option(words[k]) && !is_option(words[k + 1])) check_value(choice, known, words[k], words[k + 1]);
}

void try_options(const SolverChoice& choice, bool with_blood, bool lagged_mesh) {
  if (words_in(given_options(choice)).empty()) return;
  const Scene scene =
      parse_scene(std::string(small_vessel) + (with_blood ? "" : without_blood), "trial", ".");
  const auto setup = setup_of(scene);
  setup->problem.discretisation.lagged_mesh = lagged_mesh && with_blood;
  const Ranks alone(PETSC_COMM_SELF);
  try {
    const Assembler assembler(setup->problem, alone, {choice.name, silent(choice.options)});
    const Layout& layout = assembler.layout();
    std::vector<double> y(layout.size(), 0.0), right(layout.unknowns(), 1.0);
    const std::vector<double> mesh(layout.mesh_follows() ? layout.velocity_begin() : 0, 0.0);
    const double rate = with_blood ? 1e3 : 0;
    const coupled::Stage stage{1e-3, rate, {}, mesh, mesh};
    assembler.complete(stage, y);
    // Whether it finds a solution is another question.
    if (assembler.share().factorise(assembler.loaded(stage, y), y)) assembler.share().solve(right);
  } catch (const PetscFailure& error) {
    refuse(choice, fmt::format("PETSc refuses them, or those of PETSC_OPTIONS: {}", error.what()));
  }
}

}  // namespace tunica::full3d
