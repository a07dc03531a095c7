// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/observables/result.hpp"
#include "core/scene/scene.hpp"

namespace tunica::observables {

/// What a user should know of the last beat of a run that reached its end, one line each: pressures that no
/// living artery has, a state at its end that is not the one at its start (it is then no beat of a limit
/// cycle), and a mean flow that leaves through the inlet. Pressures are judged where a prescribed flow makes
/// them at a resistance; whether the beat repeats itself, from the second on or where the run started from a
/// steady state or the limit cycle. `pressure_is_given`: at the inlet, see Inlet.
std::vector<std::string> beat_remarks(const Scene& scene, bool pressure_is_given, const Result& result);

}  // namespace tunica::observables
