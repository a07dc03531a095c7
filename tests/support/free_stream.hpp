// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/coupled/simulation.hpp"

namespace tunica::test_support {

inline constexpr std::array time_methods{time::Method::bdf2, time::Method::backward_euler,
                                         time::Method::generalized_alpha};
inline constexpr std::array time_method_names{"bdf2", "backward_euler", "generalized_alpha"};

/// A uniform stream on a mesh that moves as prescribed.
struct FreeStream {
  double worst = 0;  ///< departure of velocity and pressure, relative to their sizes
  double least_jacobian = 1;
  double greatest_mesh_speed = 0;  ///< of a component
};

/// Begins with the uniform stream in `state` and takes steps whose mean is `step`.
inline FreeStream keep_stream(const coupled::Equations& equations, time::Method method,
                              std::vector<double> state, int count, double step) {
  const coupled::Layout& layout = equations.layout();
  const std::vector<double> uniform = state;
  const auto size = [&](std::size_t begin, std::size_t end) {
    double greatest = 0;
    for (std::size_t e = begin; e < end; ++e) greatest = std::max(greatest, std::abs(uniform[e]));
    return greatest;
  };
  const double speed = size(layout.velocity_begin(), layout.pressure_begin()),
               pressure = size(layout.pressure_begin(), layout.scalar_begin());
  coupled::Newton newton(equations);
  coupled::ExpectedMesh mesh(layout);
  time::Scheme scheme(method);
  scheme.start(0, state, std::vector<double>(state.size(), 0.0));
  FreeStream stream;
  for (int k = 0; k < count; ++k) {
    // Steps that differ, so that no coefficient is what it is for equal ones.
    const time::Stage& at = scheme.begin(step * (1 + 0.5 * std::sin(k)));
    std::copy(scheme.prediction().begin(), scheme.prediction().end(), state.begin());
    const auto report = newton.solve(mesh.stage(scheme, at.time), state, {1e-13, 20});
    if (!report.converged) {
      ADD_FAILURE() << "step " << k << ": " << report.failure;
      return stream;
    }
    stream.least_jacobian = std::min(stream.least_jacobian, equations.least_jacobian().value);
    equations.follow(at.time, state);
    scheme.accept(state);
    for (std::size_t e = layout.velocity_begin(); e < layout.scalar_begin(); ++e)
      stream.worst = std::max(stream.worst, std::abs(scheme.value()[e] - uniform[e]) /
                                                (e < layout.pressure_begin() ? speed : pressure));
    for (std::size_t e = 0; e < layout.velocity_begin(); ++e)
      stream.greatest_mesh_speed = std::max(stream.greatest_mesh_speed, std::abs(scheme.rate()[e]));
  }
  return stream;
}

}  // namespace tunica::test_support
