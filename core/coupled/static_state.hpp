// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/coupled/loading.hpp"

namespace tunica::coupled {

struct StaticReport {
  int load_steps = 0;
  int rejected = 0;
  int guesses_missed = 0;  ///< guesses that Newton's method did not get from to the state: steps in time did
  NewtonCounts coarse;     ///< of solvers other than the one that was given
};

/// A mesh of the vessel with its loads and equations.
class StaticMesh {
 public:
  virtual ~StaticMesh() = default;
  virtual Loading& loading() = 0;
  virtual const Equations& equations() const = 0;
};

/// Coarser meshes of a vessel that lead to the one to be solved on, each of at most about twice the cells in
/// a direction; possibly none.
class CoarserMeshes {
 public:
  virtual ~CoarserMeshes() = default;
  virtual int count() const = 0;
  virtual std::unique_ptr<StaticMesh> make(int index) const = 0;
  /// A state on one of the meshes, interpolated to the next or to the finest one.
  virtual std::vector<double> prolong(const Equations& from, std::span<const double> y,
                                      const Equations& to) const = 0;
};

/// The steady state under the loads of a time: wall in equilibrium, and blood in steady flow or at rest.
///
/// On the coarsest mesh Newton's method begins from what is known of tubes (tube_state). Where that does not
/// lead to the state, loads grow from nothing in steps of about 15 mmHg. Each begins from the polynomial
/// through the states before, as a function of the lumen's displacement of a ring at mid-length; the first,
/// and one that is not solved from there, is approached by steps in time. A load that is not solved at all is
/// halved. The state under the whole load is then the guess on the next mesh, and so on to the finest, that
/// of `newton`. Where there is no coarser mesh, or it does not lead there, loads grow on the mesh itself.
///
/// Leaves loading.load at 1. Throws SolverFailure when a load cannot be reached: which, where and why.
/// `interrupted` is asked between steps; when it says so, an empty state is returned.
std::vector<double> static_state(Loading& loading, const Equations& equations, const CoarserMeshes& coarser,
                                 Newton& newton, double time, double tolerance,
                                 const std::function<bool()>& interrupted, StaticReport& report);

}  // namespace tunica::coupled
