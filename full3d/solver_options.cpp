// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/solver_options.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "core/error.hpp"

namespace tunica::embedded {
std::string_view solver_direct();
}

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

}  // namespace

std::vector<std::string> solver_names() {
  return {"direct"};
}

void insert_options(const SolverChoice& choice) {
  const auto insert = [](const std::string& text) {
    check(PetscOptionsInsertString(nullptr, text.c_str()), "PetscOptionsInsertString");
  };
  insert(options_in(embedded::solver_direct()));
  if (!choice.options.empty() && choice.options.front() != '-')
    throw InvalidInput(
        fmt::format("solver.options = \"{}\" is not a list of PETSc options, such as \"-ksp_rtol 1e-8\"",
                    choice.options));
  insert(choice.options);
  if (const char* environment = std::getenv("PETSC_OPTIONS")) insert(environment);
}

void try_options(const SolverChoice& choice) {
  insert_options(choice);
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
    check(KSPSetUp(solver.get()), "KSPSetUp");
  } catch (const std::runtime_error& error) {
    throw InvalidInput(
        fmt::format("solver.options = \"{}\": PETSc refuses them, or those of PETSC_OPTIONS: {}",
                    choice.options, error.what()));
  }
}

std::vector<std::string> unused_options() {
  PetscInt count = 0;
  char **names = nullptr, **values = nullptr;
  check(PetscOptionsLeftGet(nullptr, &count, &names, &values), "PetscOptionsLeftGet");
  std::vector<std::string> unused;
  for (PetscInt k = 0; k < count; ++k) unused.emplace_back(names[k]);
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
