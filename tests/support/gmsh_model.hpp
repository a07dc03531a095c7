// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace tunica::test_support {

/// What a Gmsh file holds, to be spoilt and written.
struct GmshModel {
  struct Node {
    long tag;
    double x, y, z;
  };
  struct Element {
    long tag;
    int type;          ///< Gmsh's number
    std::string name;  ///< of its physical group, empty for none
    std::vector<long> nodes;
  };
  std::vector<Node> nodes;
  std::vector<Element> elements;
  std::string comment;
  bool parametric = false;  ///< nodes of format 4.1 carry two parameters of their surface

  /// The file in format "2.2" or "4.1".
  std::string text(const std::string& version) const;
};

/// Gmsh's numbers of the cells that can be read.
enum GmshType { triangle3 = 2, quadrilateral4 = 3, triangle6 = 9, quadrilateral9 = 10, quadrilateral8 = 16 };

/// A straight wall whose lumen narrows smoothly about mid-length:
/// R(z) = R0 (1 - severity cos^2(pi (z - L/2)/width)) within width/2 of it, outer radius R0 + thickness.
struct Stenosis {
  double radius = 0.033, thickness = 0.01, length = 0.66, severity = 0.4, width = 0.2;
  int blood_cells = 4, wall_cells = 2, axial_cells = 48;  ///< no cells: the part is left out
  int type = triangle6;
  bool layered = false;      ///< each column of the wall is a layer: "wall:1", "wall:2", ...
  bool name_inside = false;  ///< names axis and interface too

  double lumen(double z) const;
};

/// Its mesh, all nodes on the curves of constant R(z) fraction.
GmshModel stenosis_mesh(const Stenosis& shape);

}  // namespace tunica::test_support
