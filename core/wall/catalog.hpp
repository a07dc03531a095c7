// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tunica::wall {

/// The part of a law that does not know fibres.
enum class Matrix {
  exp1,                      ///< alpha/2gamma (exp(gamma (I1bar-3)) - 1)
  exp2,                      ///< alpha/2gamma (exp(gamma (I1bar-3)^2) - 1)
  neo_hookean,               ///< mu/2 (I1bar-3), with U(J)
  neo_hookean_compressible,  ///< mu/2 (I1 - 3 - 2 ln J) + lambda/2 ln^2 J
  st_venant_kirchhoff,       ///< lambda/2 tr^2 E + mu E:E
  linear_elastic             ///< lambda/2 tr^2 e + mu e:e, e the small strain
};

/// A parameter that a law reads, below "wall." (or below a layer), with the law's own default.
struct LawParameter {
  std::string_view key;
  double value;
};

/// A law by the name that scenes use.
struct LawEntry {
  std::string_view name;
  Matrix matrix;
  bool has_fibers;
  bool has_activation;  ///< false: fibres are recruited from the unloaded state, a^2 = 1
  bool splits_volume;   ///< U(J) + isochoric part, so that it can be made exactly incompressible
  std::vector<LawParameter> parameters;
  std::string_view meaning;
};

/// Every named law, the paper's four first (Table 1), then the benchmark laws.
const std::vector<LawEntry>& laws();
/// Null when there is no law of that name.
const LawEntry* find_law(std::string_view name);
/// True when the law reads the parameter `key` (the part after "wall." or "wall.layers[i].").
bool law_reads(const LawEntry& law, std::string_view key);

}  // namespace tunica::wall
