// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "full3d/o_grid.hpp"
#include "tests/support/gmsh_model.hpp"

namespace tunica::test_support {

/// A mesh in space as a Gmsh file holds it: hexahedra of 27 nodes (8 of a linear mesh) or tetrahedra of 10
/// (4), with their faces on boundaries other than the interface (of a wall alone that too). Tags are the
/// mesh's numbers and 1.
GmshModel gmsh_model(const full3d::Mesh& mesh);

/// The same with middles of edges alone in hexahedra (20 nodes).
GmshModel serendipity(GmshModel model);

/// A bend whose elliptic lumen and wall become narrower downstream: the straight vessel of a spec, (x, y)
/// scaled by (1.2, 0.85) (1 - taper s/L), and bent by an angle.
full3d::Mesh tapering_bend(const full3d::VesselSpec& spec, double taper, double angle);

}  // namespace tunica::test_support
