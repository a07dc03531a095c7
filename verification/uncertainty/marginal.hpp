// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace tunica::uncertainty {

/// The distribution of one number, independent of others. Numbers are in the unit of the key that it is for.
struct Marginal {
  enum class Kind {
    uniform,      ///< between a and b
    log_uniform,  ///< its logarithm is uniform; between a and b, both above 0
    normal,       ///< mean a, standard deviation b
    lognormal,    ///< mean a and standard deviation b of the number itself, not of its logarithm
    triangular    ///< from a over its mode c to b
  };
  Kind kind = Kind::uniform;
  double a = 0, b = 1, c = 0;

  /// Value below which the number is with probability p, 0 < p < 1.
  double quantile(double p) const;
  /// Probability that the number is at most x.
  double probability(double x) const;
  /// Whether the number can be x, ends included.
  bool contains(double x) const;
  double mean() const;
  double standard_deviation() const;
  /// "uniform(1, 2)", as parse_marginal reads it; a log-uniform one as "loguniform(1, 2)".
  std::string text() const;
};

/// Reads "normal(M,SD)", "lognormal(M,SD)", "uniform(A,B)", "loguniform(A,B)", "triangular(A,C,B)"; numbers
/// may carry a unit. None for text that does not have the form of a call. Throws InvalidInput naming what is
/// wrong and the distributions that there are; `key` and its `unit` are for units and messages.
std::optional<Marginal> parse_marginal(std::string_view text, const std::string& key,
                                       const std::string& unit);

}  // namespace tunica::uncertainty
