// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "full3d/full3d_tier.hpp"
#include "tests/support/axisym_runs.hpp"

namespace tunica::test_support {

/// Runs the 3D tier in this process; a run that gives up fails the test.
inline Result run_full3d(const Scene& scene) {
  const full3d::Ranks ranks;
  full3d::Team team(ranks);
  Result result = full3d::Full3dTier(team).prepare(scene)->execute({});
  EXPECT_EQ(result.record.failure, "");
  EXPECT_TRUE(result.record.converged);
  return result;
}

/// The fewest cells that a vessel has.
inline const std::vector<std::string> coarsest{"mesh.wall_cells=1", "mesh.blood_cells=1",
                                               "mesh.axial_cells=6", "mesh.around_cells=8"};

/// A tenth of a second in which a steady flow comes on.
inline const std::vector<std::string> short_flow{"inlet.waveform=constant", "inlet.flow=0.02",
                                                 "inlet.period=0.1",        "time.beats=1",
                                                 "time.step=0.01",          "output.interval=0.01"};

inline std::vector<std::string> joined(std::vector<std::string> all,
                                       std::initializer_list<std::vector<std::string>> more) {
  for (const auto& each : more) all.insert(all.end(), each.begin(), each.end());
  return all;
}

inline double greatest(const std::vector<double>& values) {
  double most = 0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}
inline double range(const std::vector<double>& values) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return *most - *least;
}
inline double difference(const std::vector<double>& a, const std::vector<double>& b) {
  EXPECT_EQ(a.size(), b.size());
  double most = 0;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) most = std::max(most, std::abs(a[k] - b[k]));
  return most;
}

/// Greatest difference between the observables of a torus and the mirror image of another's about the plane
/// of its bend, relative to the greatest value of each.
inline double difference_of_mirror_images(const observables::Table& table, const observables::Table& other) {
  double most = 0;
  for (int point = 1; point <= 4; ++point)
    for (const auto& [here, there] :
         {std::pair{"", ""}, {".90deg", ".270deg"}, {".180deg", ".180deg"}, {".270deg", ".90deg"}})
      for (const std::string quantity :
           {"radial_displacement", "fiber_stretch", "recruitment", "von_mises"}) {
        const std::string at = quantity + ".P" + std::to_string(point);
        const auto& values_here = values(table, at + here);
        EXPECT_GT(greatest(values_here), 0) << at << here;
        most = std::max(most, difference(values_here, values(other, at + there)) / greatest(values_here));
      }
  return most;
}

}  // namespace tunica::test_support
