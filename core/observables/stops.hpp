// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/scene/scene.hpp"

namespace tunica::observables {

/// A moment at which the run stops to look.
struct Stop {
  double time;              ///< s
  bool is_row = false;      ///< a row of observables.csv
  bool is_profile = false;  ///< a profile through the wall
  bool is_field = false;    ///< the wall's cross-section for fields/
  bool begins_last_beat = false;
};

/// The stops of a scene with beats of `period` seconds, in order: rows every output.interval and fields
/// every output.field_interval, both from 0 and at the end too, and output.profile_times in the last beat, at
/// which there are profiles and, unless output.field_interval is 0, fields as well.
std::vector<Stop> stops(const Scene& scene, double period);

/// Throws InvalidInput, naming the key, when rows of `columns` numbers and pictures of `numbers` take more
/// memory than is available. `copies`: how often a run holds them at a time, its checkpoints included.
void check_output_memory(const Scene& scene, const std::vector<Stop>& stops, std::size_t columns,
                         std::size_t numbers, double copies);
/// The same for a given amount, bytes; none where it is not known.
void check_output_memory(const Scene& scene, const std::vector<Stop>& stops, std::size_t columns,
                         std::size_t numbers, double copies, std::optional<double> available);

}  // namespace tunica::observables
