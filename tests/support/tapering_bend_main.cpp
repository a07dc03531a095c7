// SPDX-License-Identifier: GPL-3.0-or-later
// Writes scenes/tapering_bend.msh: build the target tapering_bend_mesh, then
// build/release/tests/unit/tapering_bend_mesh scenes/tapering_bend.msh
#include <fstream>
#include <iostream>
#include <numbers>

#include "tests/support/solid_gmsh.hpp"

int main(int count, char** arguments) {
  if (count != 2) {
    std::cerr << "usage: tapering_bend_mesh FILE\n";
    return 2;
  }
  using namespace tunica;
  full3d::VesselSpec spec;
  spec.radius = 0.033;
  spec.layers = {0.01};
  spec.length = 0.4;
  spec.around_cells = 8;
  spec.ring_cells = 2;
  spec.wall_cells = 2;
  spec.axial_cells = 12;
  spec.end_grading = spec.interface_grading = 3;
  test_support::GmshModel model =
      test_support::gmsh_model(test_support::tapering_bend(spec, 0.3, std::numbers::pi / 2));
  model.comment =
      "SPDX-License-Identifier: GPL-3.0-or-later\n"
      "A quarter of a bend (cm) whose elliptic section becomes smaller by 30 %, from a straight artery of "
      "radius\n"
      "0.033, thickness 0.01 and length 0.4: (x, y) scaled by (1.2, 0.85) (1 - 0.3 z/0.4), then bent; made "
      "by\n"
      "tests/support/tapering_bend_main.cpp.";
  std::ofstream file(arguments[1], std::ios::binary);
  file << model.text("4.1");
  file.close();
  return file ? 0 : 1;
}
