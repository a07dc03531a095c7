// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/run/door.hpp"

/// The elastic-tube benchmark: what is asked of a run of scenes/elastic_tube.toml, and what is published.
namespace tunica::verification {

/// Radial displacement of the inner wall at mid-length.
struct TubeTrace {
  std::vector<double> time;          ///< s
  std::vector<double> displacement;  ///< mm
  double at(double time) const;      ///< linear between the times
};

struct TubePeak {
  double time;          ///< s
  double displacement;  ///< mm
};
/// Vertex of the parabola through the greatest value and its neighbours.
/// Throws std::logic_error when the greatest value is the first or the last.
TubePeak peak_of(const TubeTrace& trace);

struct TubeRun {
  TubeTrace trace;
  TubePeak peak;
  long unknowns, steps;
  double seconds;
};
/// What is asked of a run that was computed in this process. Throws SolverFailure where it is not done.
TubeRun tube_run(const run::Outcome& outcome);

/// Greatest difference of two traces up to a time, mm, at the times of the second.
double greatest_difference(const TubeTrace& trace, const TubeTrace& reference, double until);

/// Richardson's extrapolation of values whose errors fall with the order when steps are halved.
double extrapolated(double coarse, double fine, double order);
/// Order that three values show, each with half the step of the one before; none when they do not run one
/// way.
std::optional<double> observed_order(double coarse, double middle, double fine);
/// "1.98", or why there is none: "not monotone", or "converged" where the last two differ by less than 1e-5
/// of them.
std::string order_text(double coarse, double middle, double fine);

/// Peaks that solids4foam publishes, with BDF2 (github.com/solids4foam/solids4foam-tutorials-benchmark-data,
/// tutorials/fluidSolidInteraction/3dTube/v2012/sonicLiquidFluid/aitkens/backward).
struct PublishedTube {
  double step;  ///< s
  TubePeak peak;
};
inline constexpr std::array<PublishedTube, 5> published_tube{{{8e-4, {7.2e-3, 0.0909}},
                                                              {4e-4, {7.6e-3, 0.1215}},
                                                              {2e-4, {7.4e-3, 0.1443}},
                                                              {1e-4, {7.3e-3, 0.1540}},
                                                              {5e-5, {7.3e-3, 0.1573}}}};
/// Their limit for small steps: observed_order of the last three is 1.56.
inline constexpr TubePeak published_limit{7.3e-3, 0.159};
/// How near the limits of both have to be, relative.
inline constexpr double displacement_bar = 0.015, time_bar = 0.02;

}  // namespace tunica::verification
