// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/solver_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string_view>

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

}  // namespace

std::vector<std::string> words_in(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

std::string given_options(const SolverChoice& choice) {
  const char* environment = std::getenv("PETSC_OPTIONS");
  return choice.options + " " + (environment ? environment : "");
}

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
  insert(given_options(choice));
}

std::vector<std::string> unused_options(const SolverChoice& choice) {
  const std::vector<std::string> given = words_in(given_options(choice));
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
