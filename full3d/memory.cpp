// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/memory.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"
#include "core/memory.hpp"

namespace tunica::full3d {

double estimated_memory(const std::string& method, int unknowns) {
  const double n = unknowns;
  // The matrix with the cells' entries that it is summed of, and copies of its blocks; and, without factors
  // of the whole, those of the parts that are solved exactly.
  const double matrix = 10e3 * n;
  if (method != "direct") return matrix + 20e3 * n;
  // Factors as they were measured, and what MUMPS takes besides.
  const double factor_entries = 7.4 * std::pow(n, 1.495);
  return matrix + 1.6 * 8 * factor_entries;
}

void check_memory(const std::string& method, int unknowns, std::optional<double> available) {
  const double needed = estimated_memory(method, unknowns);
  if (!available || needed <= *available) return;
  const bool block_fits = method != "block" && estimated_memory("block", unknowns) <= *available;
  throw InvalidInput(fmt::format(
      "the mesh makes {} equations, which take an estimated {:.3g} GiB with solver.method = \"{}\", and this "
      "machine has {:.3g} GiB available; {}",
      unknowns, needed / gib, method, *available / gib,
      block_fits ? "write solver.method = \"block\", or ask for fewer cells (mesh.*_cells, "
                   "accuracy.tolerance, or a coarser geometry.file)"
                 : "ask for fewer cells (mesh.*_cells, accuracy.tolerance, or a coarser geometry.file)"));
}

}  // namespace tunica::full3d
