// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "full3d/assembler.hpp"
#include "full3d/resolution.hpp"

namespace tunica::full3d {

/// The leader's hold on the other ranks, which serve it for as long as it lives.
///
/// One rank, the leader, holds the run: it reads the scene, decides on steps and iterations, and writes. The
/// others hold the same problems, made of the same scene, and compute their shares of residuals, matrices and
/// solutions when they are told to. So whatever is decided is decided once, and nothing but the rounding of
/// sums depends on the number of ranks.
class Team {
 public:
  explicit Team(const Ranks& ranks) : ranks_(ranks) {}
  /// Lets the other ranks go.
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  const Ranks& ranks() const { return ranks_; }
  /// Has the other ranks set up the problem of a scene at a resolution; the announcer tells them what to do
  /// with it, and to drop it when it goes. Null with one rank.
  std::unique_ptr<Announcer> open(const Scene& scene, const Resolution& resolution, bool lagged_mesh = false);

 private:
  const Ranks& ranks_;
  int opened_ = 0;
};

/// What the other ranks do until they are let go. Throws what a share of the work throws.
void serve(const Ranks& ranks);

}  // namespace tunica::full3d
