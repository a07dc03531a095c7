// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/coupled/tangent_stability.hpp"
#include "full3d/share.hpp"
#include "full3d/vessel_shape.hpp"

namespace tunica::full3d {

using coupled::TangentStability;

/// A mode as a rank finds it.
struct LeastMode {
  TangentStability stability;  ///< without a wave length; the same on all ranks
  std::vector<double> motion;  ///< by unknown, on the leader
};

/// The least mode of a wall alone at a complete static state, by MUMPS; collective. Of motions that the
/// meshed part allows: a half or a quarter of a vessel has those that are symmetric about its planes. Throws
/// SolverFailure on all ranks when a pivot vanishes.
LeastMode least_mode(Share& share, const Problem& problem, const Layout& layout, const Ranks& ranks,
                     const LoadedStage& at, std::span<const double> y);

/// Wave length along the inner surface of a motion by unknown, where it is greatest.
double wave_length(const Problem& problem, const Layout& layout, const VesselShape& shape,
                   const std::vector<double>& motion);

}  // namespace tunica::full3d
