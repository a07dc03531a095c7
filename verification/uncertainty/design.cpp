// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/uncertainty/design.hpp"

#include <fmt/format.h>
#include <gsl/gsl_qrng.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/error.hpp"

namespace tunica::uncertainty {

namespace {

/// splitmix64 (Steele, Lea and Flood, 2014): a bijection of 64 bits whose outputs pass for random.
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31);
}

std::uint64_t hash(std::uint64_t seed, std::uint64_t stream, std::uint64_t index) {
  return mixed(mixed(mixed(seed) ^ stream) ^ index);
}

/// Within (0, 1), both ends excluded.
double unit(std::uint64_t bits) {
  return (static_cast<double>(bits >> 11) + 0.5) * 0x1p-53;
}

/// A permutation of 0 to count - 1 that needs no memory: a Feistel network on the next power of four, walked
/// on until it is back in the range.
std::uint64_t permuted(std::uint64_t index, std::uint64_t count, std::uint64_t seed, std::uint64_t stream) {
  if (count < 2) return index;
  const int half = std::max(1, (static_cast<int>(std::bit_width(count - 1)) + 1) / 2);
  const std::uint64_t mask = (std::uint64_t{1} << half) - 1;
  constexpr int rounds = 6;
  do {
    std::uint64_t left = index >> half, right = index & mask;
    for (int round = 0; round < rounds; ++round) {
      const std::uint64_t next =
          left ^ (hash(seed + static_cast<std::uint64_t>(round), stream, right) & mask);
      left = right;
      right = next;
    }
    index = (left << half) | right;
  } while (index >= count);
  return index;
}

}  // namespace

struct Design::Sequence {
  explicit Sequence(int dimension)
      : generator(gsl_qrng_alloc(gsl_qrng_sobol, static_cast<unsigned>(dimension))) {}
  Sequence(const Sequence&) = delete;
  Sequence& operator=(const Sequence&) = delete;
  ~Sequence() { gsl_qrng_free(generator); }

  void go_to(std::uint64_t index, double* coordinates) {
    if (index < next) {
      gsl_qrng_init(generator);
      next = 0;
    }
    for (; next <= index; ++next)
      if (gsl_qrng_get(generator, coordinates) != 0)
        throw InvalidInput(fmt::format("Sobol's sequence ends before point {}", index + 1));
  }

  gsl_qrng* generator;
  std::uint64_t next = 0;
};

const char* name_of(Sampling sampling) {
  switch (sampling) {
    case Sampling::sobol:
      return "sobol";
    case Sampling::latin_hypercube:
      return "lhs";
    default:
      return "random";
  }
}

Design::Design(Sampling sampling, std::uint64_t count, int dimension, std::uint64_t seed)
    : sampling_(sampling), count_(count), seed_(seed), dimension_(dimension) {
  if (count == 0) throw InvalidInput("a sample of 0 points; ask for at least 1");
  if (dimension < 1) throw InvalidInput("a sample of no parameter; name what varies with --vary");
  constexpr int most = 40, most_bits = 30;
  if (sampling != Sampling::sobol) return;
  if (dimension > most)
    throw InvalidInput(
        fmt::format("Sobol's sequence has at most {} coordinates, not {}; take lhs or random, or vary less",
                    most, dimension));
  if (count >= (std::uint64_t{1} << most_bits))
    throw InvalidInput(fmt::format("Sobol's sequence has at most {} points, not {}",
                                   (std::uint64_t{1} << most_bits) - 1, count));
  sequence_ = std::make_unique<Sequence>(dimension);
}
Design::~Design() = default;
Design::Design(Design&&) noexcept = default;

void Design::point(std::uint64_t index, double* coordinates) {
  if (sampling_ == Sampling::sobol) {
    sequence_->go_to(index, coordinates);
    if (seed_ == 0) return;
    for (int k = 0; k < dimension_; ++k) {
      const double shifted = coordinates[k] + unit(hash(seed_, static_cast<std::uint64_t>(k), 0));
      // A sum of exactly 1 would be 0, which no quantile bears.
      coordinates[k] = std::clamp(shifted - std::floor(shifted), 0x1p-53, 1 - 0x1p-53);
    }
    return;
  }
  for (int k = 0; k < dimension_; ++k) {
    const auto stream = static_cast<std::uint64_t>(k);
    const double within = unit(hash(seed_, stream, index));
    coordinates[k] = sampling_ == Sampling::random
                         ? within
                         : (static_cast<double>(permuted(index, count_, mixed(seed_ + 1), stream)) + within) /
                               static_cast<double>(count_);
  }
}

}  // namespace tunica::uncertainty
