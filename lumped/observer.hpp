// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/observables/result.hpp"
#include "lumped/network.hpp"

namespace tunica::lumped {

/// Turns states of the network into the tables of a result.
class Observer {
 public:
  Observer(const Network& network, const std::vector<std::string>& parameters);

  /// One row of observables.csv.
  observables::Sample sample(double time, const double* y) const;
  /// One row of sensitivities.csv; `sensitivities[k]` is dy/d(parameter k).
  void append_sensitivities(double time, const double* y, const std::vector<const double*>& sensitivities,
                            observables::Table& table) const;
  /// Rows of profiles.csv: the wall at mid-length from the inner to the outer surface.
  void append_profile(double time, const double* y, observables::Table& table) const;

  observables::Table sensitivity_table() const;

  /// "d(pressure)/d(outlet.resistance)" and its unit.
  std::string derivative_name(std::string_view quantity, std::size_t k) const;
  std::string derivative_unit(std::string_view unit, std::size_t k) const;

 private:
  const Network& network_;
  std::vector<std::string> parameters_;
  std::vector<std::size_t> place_layers_;  ///< layer of P1..P4
};

}  // namespace tunica::lumped
