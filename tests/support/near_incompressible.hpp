// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/frame.hpp"
#include "core/radial/from_scene.hpp"
#include "core/radial/wall_curve.hpp"
#include "tests/support/axisym_runs.hpp"
#include "tests/support/lame_tube.hpp"

/// Tubes of nearly incompressible tissue under pressure, whose ends slide, on the cells of a tolerance of 1
/// %: rings in plane strain.
namespace tunica::test_support {

struct WallAnswer {
  std::array<double, 4> displacement, von_mises;  ///< at P1 to P4
};

inline constexpr std::array places_in_wall{0.0, 1.0 / 3, 2.0 / 3, 1.0};

/// A free tube of the paper's size, strained by 1e-5, so that linear theory is right to that.
inline Scene lame_scene(const std::string& law, double poisson_ratio,
                        const std::vector<std::string>& more = {}) {
  std::vector<std::string> all{"wall.law=" + law,
                               "wall.young_modulus=3e6",
                               "wall.poisson_ratio=" + fmt::format("{:.9g}", poisson_ratio),
                               "inlet.pressure=10",
                               "tether.stiffness=0",
                               "inlet.waveform=pressure",
                               "time.mode=static",
                               "geometry.ends=sliding",
                               "mesh.wall_cells=3",
                               "mesh.blood_cells=2",
                               "mesh.axial_cells=14"};
  all.insert(all.end(), more.begin(), more.end());
  return artery(all);
}

inline WallAnswer lame_answer(double poisson_ratio) {
  const LameTube tube({0.033, 0.01, 3e6, poisson_ratio}, 10);
  WallAnswer answer{};
  for (int p = 0; p < 4; ++p) {
    const auto point = tube.at(0.033 + 0.01 * places_in_wall[p]);
    answer.displacement[p] = point.displacement[0];
    answer.von_mises[p] = von_mises_stress(point.stress);
  }
  return answer;
}

/// At the scene's pressure, by the 0D wall: elements of degree 8.
inline WallAnswer ring_answer(const Scene& scene) {
  const radial::WallCurve curve(radial::ring_model(scene, {}), {0.0});
  const auto response =
      curve.model().respond(curve.stretch_at(scene.number("inlet.pressure")), places_in_wall, false);
  const auto& ring = curve.model().ring();
  WallAnswer answer{};
  for (int p = 0; p < 4; ++p) {
    const auto& state = response.states[p];
    const auto gradient =
        frame::Radial::gradient(state.displacement, state.radial_slope, ring.radius(places_in_wall[p]));
    answer.displacement[p] = state.displacement;
    answer.von_mises[p] = von_mises_stress(
        cauchy_stress(wall::piola(ring.layers.front().law, gradient, frame::Radial::axes()), gradient));
  }
  return answer;
}

inline WallAnswer answer_of(const Result& result) {
  WallAnswer answer{};
  for (int p = 0; p < 4; ++p) {
    answer.displacement[p] = values(result.observables, fmt::format("radial_displacement.P{}", p + 1)).at(0);
    answer.von_mises[p] = values(result.observables, fmt::format("von_mises.P{}", p + 1)).at(0);
  }
  return answer;
}

/// Relative differences, each at most its tolerance.
inline void expect_close(const WallAnswer& answer, const WallAnswer& exact, double displacement,
                         double von_mises) {
  for (int p = 0; p < 4; ++p) {
    EXPECT_NEAR(answer.displacement[p] / exact.displacement[p], 1, displacement) << "P" << p + 1;
    EXPECT_NEAR(answer.von_mises[p] / exact.von_mises[p], 1, von_mises) << "P" << p + 1;
  }
}

/// Laws whose bulk modulus is 1e5 and more times their shear modulus, at finite strain.
inline std::vector<std::vector<std::string>> stiff_walls() {
  return {{"wall.law=St-Venant-Kirchhoff", "wall.young_modulus=3e6", "wall.poisson_ratio=0.499999"},
          {"wall.law=neo-Hookean-compressible", "wall.shear_modulus=3e5", "wall.bulk_modulus=1e11"},
          {"wall.law=neo-Hookean", "wall.shear_modulus=3e5", "wall.bulk_modulus=1e11"},
          {"wall.law=EXP1", "wall.bulk_modulus=1e11"}};
}

inline Scene stiff_scene(std::vector<std::string> wall) {
  wall.insert(wall.end(),
              {"inlet.waveform=pressure", "inlet.pressure=100 mmHg", "time.mode=static",
               "geometry.ends=sliding", "mesh.wall_cells=3", "mesh.blood_cells=2", "mesh.axial_cells=14"});
  return artery(wall);
}

}  // namespace tunica::test_support
