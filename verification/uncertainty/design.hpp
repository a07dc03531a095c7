// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace tunica::uncertainty {

enum class Sampling { sobol, latin_hypercube, random };
/// "sobol", "lhs", "random".
const char* name_of(Sampling sampling);

/// Points of the unit cube, reached by their number in constant memory and the same whatever else is asked.
///
/// sobol: Sobol's sequence (GSL) from its first point (1/2, ..., 1/2) on, so that a larger design continues a
/// smaller one; with a seed other than 0 it is shifted at random, modulo 1. lhs: in each coordinate one point
/// in each of `count` equal intervals, in the order of a random permutation, at a random place in it. random:
/// independent and uniform. The numbers of the latter two depend on seed, point and coordinate only.
class Design {
 public:
  /// Throws InvalidInput for no point, no coordinate, or more coordinates than Sobol's sequence has (40).
  Design(Sampling sampling, std::uint64_t count, int dimension, std::uint64_t seed);
  ~Design();
  Design(Design&&) noexcept;

  std::uint64_t count() const { return count_; }
  int dimension() const { return dimension_; }
  /// Coordinates of a point, each within (0, 1). Points are reached fastest one after the other. Not for
  /// several threads at once.
  void point(std::uint64_t index, double* coordinates);

 private:
  struct Sequence;

  Sampling sampling_;
  std::uint64_t count_, seed_;
  int dimension_;
  std::unique_ptr<Sequence> sequence_;  ///< of Sobol'
};

}  // namespace tunica::uncertainty
