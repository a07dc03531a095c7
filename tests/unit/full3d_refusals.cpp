// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "full3d/mesh_check.hpp"
#include "full3d/o_grid.hpp"

namespace {

using namespace tunica;
using namespace tunica::full3d;

VesselSpec small_vessel() {
  VesselSpec spec;
  spec.radius = 0.033;
  spec.layers = {0.01};
  spec.length = 0.3;
  spec.around_cells = 8;
  spec.ring_cells = spec.wall_cells = 1;
  spec.axial_cells = 4;
  return spec;
}

TEST(full3d, VesselsAreRefusedByName) {
  struct Bad {
    std::function<void(VesselSpec&)> spoil;
    std::vector<std::string> words;
  };
  const double nan = std::nan("");
  const std::vector<Bad> bad = {
      {[](VesselSpec& s) { s.radius = 0; }, {"geometry.radius = 0 cm", "positive"}},
      {[=](VesselSpec& s) { s.length = nan; }, {"geometry.length = nan", "positive"}},
      {[](VesselSpec& s) { s.layers.push_back(-0.002); }, {"geometry.thickness = -0.002", "positive"}},
      {[](VesselSpec& s) { s.layers.clear(); }, {"no layer", "thickness"}},
      {[](VesselSpec& s) { s.axial_cells = 7; }, {"mesh.axial_cells = 7 is odd", "take 8"}},
      {[](VesselSpec& s) { s.around_cells = 0; }, {"mesh.around_cells = 0", "at least 1"}},
      {[](VesselSpec& s) { s.around_cells = 12; }, {"mesh.around_cells = 12", "multiple of 8", "take 16"}},
      {[](VesselSpec& s) { s.ring_cells = 0; }, {"mesh.blood_cells = 0", "at least 1"}},
      {[](VesselSpec& s) { s.wall_cells = -1; }, {"mesh.wall_cells = -1", "at least 1"}},
      {[](VesselSpec& s) { s.end_grading = 0.5; }, {"end grading = 0.5", "1 (uniform) to 1e+06"}},
      {[](VesselSpec& s) { s.wall_grading = 1e7; }, {"wall grading = 1e+07"}},
      {[=](VesselSpec& s) { s.interface_grading = nan; }, {"interface grading = nan"}},
      {[](VesselSpec& s) { s.blood = s.wall = false; }, {"without blood and without wall"}},
      {[](VesselSpec& s) { s.bend_angle = -1; }, {"geometry.bend_angle = -57.29", "0 (straight)"}},
      {[=](VesselSpec& s) { s.bend_angle = nan; }, {"geometry.bend_angle = nan"}},
      {[](VesselSpec& s) { s.bend_angle = 6.3; }, {"geometry.bend_angle = 360.9", "full turn"}},
      {[](VesselSpec& s) {
         s.length = 0.08;
         s.bend_angle = 2;
       },
       {"geometry.bend_angle = 114.5", "geometry.length = 0.08 cm", "outer radius of 0.043 cm",
        "lower the angle"}},
      {[](VesselSpec& s) {
         s.length = 0.5;
         s.bend_angle = 4;
       },
       {"mesh.axial_cells = 4", "57.3 degrees", "at most 45", "raise mesh.axial_cells"}},
      {[](VesselSpec& s) {
         s.bend_angle = 1;
         s.sector = Sector::quarter;
       },
       {"quarter of a bent vessel", "geometry.bend_angle = 57.29", "half"}},
      {[](VesselSpec& s) { s.axial_cells = 2'000'000'000; }, {"nodes", "at most 5e+06", "mesh.axial_cells"}},
      {[](VesselSpec& s) {
         s.layers = {0.01, 1e-19};
       },
       {"no width", "fewer cells"}},
      // The bend's centre is 0.005 cm away from the wall.
      {[](VesselSpec& s) {
         s.length = 0.15;
         s.bend_angle = 3.1;
         s.axial_cells = 8;
         s.shape = Shape::tetrahedron;
       },
       {"turned inside out", "wall", "more cells around"}},
  };
  for (const Bad& each : bad) {
    VesselSpec spec = small_vessel();
    each.spoil(spec);
    try {
      o_grid_vessel(spec);
      ADD_FAILURE() << "not refused: " << each.words.front();
    } catch (const InvalidInput& error) {
      for (const std::string& word : each.words)
        EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what() << '\n' << word;
    }
  }
}

TEST(full3d, MoreCellsRemedyCellsInsideOut) {
  VesselSpec spec = small_vessel();
  spec.length = 0.15;
  spec.bend_angle = 3.1;
  spec.shape = Shape::tetrahedron;
  spec.axial_cells = 16;
  spec.around_cells = 16;
  EXPECT_NO_THROW(o_grid_vessel(spec));
}

TEST(full3d, LimitOfNodesIsExact) {
  VesselSpec spec = small_vessel();
  for (const Sector sector : {Sector::full, Sector::half, Sector::quarter})
    for (const Shape shape : {Shape::hexahedron, Shape::tetrahedron})
      for (const bool quadratic : {true, false})
        for (const bool blood : {true, false}) {
          spec.sector = sector;
          spec.shape = shape;
          spec.quadratic = quadratic;
          spec.blood = blood;
          spec.around_cells = 16;
          EXPECT_EQ(expected_nodes(spec), static_cast<double>(o_grid_vessel(spec).points.size()));
        }
}

TEST(full3d, CellsTurnedInsideOutAreNamed) {
  Mesh mesh = o_grid_vessel(small_vessel());
  std::swap(mesh.points[mesh.cells[3].nodes[0]], mesh.points[mesh.cells[3].nodes[26]]);
  EXPECT_THROW(check_cells(mesh), InvalidInput);
}

}  // namespace
