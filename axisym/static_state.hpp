// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "axisym/newton.hpp"
#include "axisym/setup.hpp"

namespace tunica::axisym {

struct StaticReport {
  int load_steps = 0;
  int rejected = 0;
  int guesses_missed = 0;  ///< guesses that Newton's method did not get from to the state: steps in time did
  NewtonCounts coarse;     ///< on the meshes that were gone through
};

/// The steady state under the loads of a time: wall in equilibrium, and blood in steady flow or at rest.
///
/// On a coarse mesh loads grow from nothing in steps of about 15 mmHg. Each begins from the polynomial
/// through the states before, as a function of the lumen's displacement of a ring at mid-length; the first,
/// and one that is not solved from there, is approached by steps in time. A load that is not solved at all is
/// halved. The state under the whole load is then the guess on a mesh of about twice the cells, and so on to
/// that of `setup`. Where there is no coarser mesh, or it does not lead there, loads grow on the mesh itself.
///
/// Leaves setup.load at 1. Throws SolverFailure when a load cannot be reached: which, where and why.
/// `interrupted` is asked between steps; when it says so, an empty state is returned.
std::vector<double> static_state(const Scene& scene, Setup& setup, const Assembler& assembler, Newton& newton,
                                 double time, double tolerance, const std::function<bool()>& interrupted,
                                 StaticReport& report);

}  // namespace tunica::axisym
