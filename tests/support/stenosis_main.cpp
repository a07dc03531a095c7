// SPDX-License-Identifier: GPL-3.0-or-later
// Writes scenes/stenosis.msh: build the target stenosis_mesh, then
// build/release/tests/unit/stenosis_mesh scenes/stenosis.msh
#include <fstream>
#include <iostream>

#include "tests/support/gmsh_model.hpp"

int main(int count, char** arguments) {
  if (count != 2) {
    std::cerr << "usage: stenosis_mesh FILE\n";
    return 2;
  }
  using namespace tunica::test_support;
  GmshModel model = stenosis_mesh({});
  model.comment =
      "SPDX-License-Identifier: GPL-3.0-or-later\n"
      "Half plane x = r, y = z (cm) of an artery with a smooth stenosis, R(z) = 0.033 (1 - 0.4 cos^2(pi (z - "
      "0.33)/0.2))\n"
      "within 0.1 cm of mid-length, outer radius 0.043; made by tests/support/stenosis_main.cpp.";
  std::ofstream file(arguments[1], std::ios::binary);
  file << model.text("4.1");
  file.close();
  return file ? 0 : 1;
}
