// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

namespace tunica::uncertainty {

/// An estimate with the ends of its 95 % interval.
struct Estimate {
  double value, low, high;
};

/// Sobol' indices of one quantity by one input. First: the share of its variance that goes when the input is
/// known. Total: the share that is left when all others are.
struct SobolIndices {
  Estimate first, total;
};

/// Outputs of a pick-freeze design of N groups: f at two independent points A and B, and for each input at A
/// with that input's coordinate from B.
struct PickFreeze {
  std::vector<double> a, b;
  std::vector<std::vector<double>> mixed;  ///< [input][group]
};

/// Fewer whole groups than these have no indices.
inline constexpr std::uint64_t fewest_groups = 4;

/// Indices of each input with centred outputs (A, B and mixed ones less their mean):
///   first: mean(f_B (f_AB - f_A)) / var (Saltelli et al. 2010), total: mean((f_A - f_AB)^2) / 2 / var
/// (Jansen 1999), var that of all f_A and f_B. Intervals are 1.96 standard deviations of a bootstrap over
/// whole groups, of so many replications from a seed. Groups with a value that is none are left out. All are
/// none where fewer than fewest_groups are left or the quantity does not vary; the ends of intervals are none
/// where it varies in so few groups that a replication without them has no variance.
std::vector<SobolIndices> sobol_indices(const PickFreeze& outputs, std::uint64_t seed = 0,
                                        int replications = 400);

/// Groups without a value that is none.
std::uint64_t whole_groups(const PickFreeze& outputs);

}  // namespace tunica::uncertainty
