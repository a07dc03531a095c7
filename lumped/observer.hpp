// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/observables/result.hpp"
#include "lumped/network.hpp"

namespace tunica::lumped {

/// Which quantities of P1..P4 a row is to have: what takes long is computed where it is looked at only.
struct Looked {
  bool in_tables = false;  ///< read stress and fibres from the wall's tables, as accurate as the scene asks
  bool fibers[observables::wall_points] = {true, true, true, true};
  bool von_mises[observables::wall_points] = {true, true, true, true};
};

/// Turns states of the network into the tables of a result.
class Observer {
 public:
  explicit Observer(const Network& network);

  /// One row of observables.csv.
  observables::Sample sample(double time, const double* y, const Looked& looked = {}) const;
  /// One row of sensitivities.csv; `sensitivities[k]` is dy/d(parameter k).
  void append_sensitivities(double time, const double* y, const std::vector<const double*>& sensitivities,
                            observables::Table& table) const;
  /// Rows of profiles.csv: the wall at mid-length from the inner to the outer surface.
  void append_profile(double time, const double* y, observables::Table& table) const;

  /// One row of compartments.csv: pressure, lumen radius and outflow of each compartment, so that the
  /// pressure drop from end to end and travelling waves can be seen.
  void append_compartments(double time, const double* y, observables::Table& table) const;
  observables::Table compartment_table() const;

 private:
  const Network& network_;
  std::vector<std::size_t> place_layers_;  ///< layer of P1..P4
};

}  // namespace tunica::lumped
