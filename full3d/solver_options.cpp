// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/solver_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "core/error.hpp"

namespace tunica::embedded {
std::string_view solver_direct();
std::string_view solver_schwarz();
std::string_view solver_block();
std::string_view solver_block_given_mesh();
}  // namespace tunica::embedded

namespace tunica::full3d {

namespace {

/// One line of options out of a file with comments.
std::string options_in(std::string_view file) {
  std::istringstream lines{std::string(file)};
  std::string all, line;
  while (std::getline(lines, line)) {
    if (const auto comment = line.find('#'); comment != std::string::npos) line.erase(comment);
    all += line + " ";
  }
  return all;
}

/// Rows of a part of an additive Schwarz method: parts that are solved exactly for less than they cost to
/// exchange. Those of the velocity's block are larger: iterations grow with the number of parts, and memory
/// with their size.
constexpr double rows_of_part = 2500, rows_of_velocity_part = 80000;

std::vector<std::string> words_in(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

/// A name of an option, not a negative number.
bool is_option(const std::string& word) {
  return word.size() > 1 && word[0] == '-' && std::isalpha(static_cast<unsigned char>(word[1]));
}

}  // namespace

std::string method_for(const std::string& name, int unknowns) {
  constexpr int most_for_direct = 300000;
  if (name != "auto") return name;
  return unknowns <= most_for_direct ? "direct" : "block";
}

void insert_options(const SolverChoice& choice, int rows) {
  const auto insert = [](const std::string& text) {
    check(PetscOptionsInsertString(nullptr, text.c_str()), "PetscOptionsInsertString");
  };
  const auto parts = [&](double rows_of_one, int least) {
    return std::max(least, static_cast<int>(std::lround(rows / rows_of_one)));
  };
  if (choice.name == "schwarz") {
    insert(options_in(embedded::solver_schwarz()));
    insert(fmt::format("-pc_asm_local_blocks {}", parts(rows_of_part, 2)));
  } else if (choice.name == "block") {
    insert(options_in(embedded::solver_block()));
    if (choice.mesh_is_given) insert(options_in(embedded::solver_block_given_mesh()));
    insert(fmt::format("-fieldsplit_motion_{}pc_asm_local_blocks {}",
                       choice.mesh_is_given ? "" : "fieldsplit_velocity_", parts(rows_of_velocity_part, 1)));
  } else {
    insert(options_in(embedded::solver_direct()));
  }
  insert(choice.options);
  if (const char* environment = std::getenv("PETSC_OPTIONS")) insert(environment);
}

void try_options(const SolverChoice& choice) {
  insert_options(choice, 1);
  OwnedMatrix one;
  OwnedSolver solver;
  check(MatCreateSeqAIJ(PETSC_COMM_SELF, 1, 1, 1, nullptr, one.put()), "MatCreateSeqAIJ");
  check(MatSetValue(one.get(), 0, 0, 1, INSERT_VALUES), "MatSetValue");
  check(MatAssemblyBegin(one.get(), MAT_FINAL_ASSEMBLY), "MatAssemblyBegin");
  check(MatAssemblyEnd(one.get(), MAT_FINAL_ASSEMBLY), "MatAssemblyEnd");
  check(KSPCreate(PETSC_COMM_SELF, solver.put()), "KSPCreate");
  check(KSPSetOperators(solver.get(), one.get(), one.get()), "KSPSetOperators");
  try {
    check(KSPSetFromOptions(solver.get()), "KSPSetFromOptions");
    // Preconditioners of parts and blocks make nothing of one row.
    if (choice.name != "schwarz" && choice.name != "block") check(KSPSetUp(solver.get()), "KSPSetUp");
  } catch (const std::runtime_error& error) {
    throw InvalidInput(
        fmt::format("solver.options = \"{}\": PETSc refuses them, or those of PETSC_OPTIONS: {}",
                    choice.options, error.what()));
  }
}

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
}

std::vector<std::string> unused_options(const SolverChoice& choice) {
  const char* environment = std::getenv("PETSC_OPTIONS");
  std::vector<std::string> given = words_in(choice.options + " " + (environment ? environment : ""));
  PetscInt count = 0;
  char **names = nullptr, **values = nullptr;
  check(PetscOptionsLeftGet(nullptr, &count, &names, &values), "PetscOptionsLeftGet");
  std::vector<std::string> unused;
  for (PetscInt k = 0; k < count; ++k) {
    const std::string name = fmt::format("-{}", names[k]);
    if (std::find(given.begin(), given.end(), name) != given.end()) unused.push_back(name);
  }
  check(PetscOptionsLeftRestore(nullptr, &count, &names, &values), "PetscOptionsLeftRestore");
  return unused;
}

double factor_entries(PC pc) {
  PetscBool direct = PETSC_FALSE;
  check(PetscObjectTypeCompareAny(reinterpret_cast<PetscObject>(pc), &direct, PCLU, PCCHOLESKY, ""),
        "PetscObjectTypeCompareAny");
  if (!direct) return 0;
  Mat factors = nullptr;
  check(PCFactorGetMatrix(pc, &factors), "PCFactorGetMatrix");
  MatInfo info{};
  check(MatGetInfo(factors, MAT_GLOBAL_SUM, &info), "MatGetInfo");
  return info.nz_used;
}

}  // namespace tunica::full3d
