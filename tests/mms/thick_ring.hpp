// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/coupled/conditions.hpp"
#include "core/coupled/newton.hpp"
#include "core/radial/wall_curve.hpp"
#include "core/wall/from_scene.hpp"
#include "tests/support/ring_cases.hpp"
#include "tests/support/round_place.hpp"

namespace tunica::test_support {

/// A slice of a long artery under pressure, its ends sliding: the thick ring of the 0D wall.
class ThickRing {
 public:
  ThickRing(const std::string& law, double pressure)
      : scene_(scene_with({"wall.law=\"" + law + "\""})),
        curve_(radial::ring_model(scene_, {}), {}),
        pressure_(pressure),
        stretch_(curve_.stretch_at(pressure)) {}

  double inner_radius() const { return curve_.model().ring().inner_radius; }
  double thickness() const { return curve_.model().ring().thickness; }

  template <int dimension>
  void set_conditions(coupled::Conditions<dimension>& conditions) const {
    const auto& ring = curve_.model().ring();
    conditions.laws = {wall::wall_from_scene(SeededScene<double>(scene_))[0].law};
    conditions.tether = {ring.tether_stiffness, ring.traction};
    conditions.lumen_pressure = [this](double) { return pressure_; };
    for (const auto end : {coupled::Boundary::wall_inlet, coupled::Boundary::wall_outlet})
      conditions.on(end).displacement.back() = true;
  }

  /// Greatest difference of the displacement in the section at any node, and greatest axial displacement,
  /// relative to the displacement of the lumen.
  struct Difference {
    double radial = 0, axial = 0;
  };
  template <std::size_t dimension>
  Difference difference(const coupled::Equations& equations,
                        const std::vector<std::array<double, dimension>>& points) const {
    constexpr int axial = static_cast<int>(dimension) - 1;
    std::vector<double> places;
    for (const auto& point : points)
      places.push_back(std::clamp((round_place(point).radius - inner_radius()) / thickness(), 0.0, 1.0));
    const auto exact = curve_.model().respond(stretch_, places, false).states;
    const coupled::Layout& layout = equations.layout();
    std::vector<double> y(layout.size());
    const auto for_each_entry = [&](const auto& visit) {
      for (int node = 0; node < layout.nodes(); ++node)
        for (int c = 0; c <= axial && layout.has_displacement(node); ++c)
          visit(layout.displacement(node, c), c,
                round_place(points[node]).radial[c] * exact[node].displacement);
    };
    for_each_entry([&](std::size_t entry, int, double u) { y[entry] = u; });
    coupled::Newton newton(equations);
    const auto report = newton.solve({}, y, {1e-12, 60});
    EXPECT_TRUE(report.converged) << report.failure;
    Difference greatest;
    const double lumen = (stretch_ - 1) * inner_radius();
    for_each_entry([&](std::size_t entry, int c, double u) {
      double& most = c == axial ? greatest.axial : greatest.radial;
      most = std::max(most, std::abs(y[entry] - u) / lumen);
    });
    return greatest;
  }

 private:
  Scene scene_;
  radial::WallCurve curve_;
  double pressure_, stretch_;
};

}  // namespace tunica::test_support
