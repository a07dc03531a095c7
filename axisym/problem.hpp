// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "axisym/mesh.hpp"
#include "core/coupled/conditions.hpp"

namespace tunica::axisym {

using Point = std::array<double, 2>;  ///< (r, z) in the reference mesh, cm

using coupled::Discretisation;
using coupled::Element;
using coupled::InletCondition;
using coupled::InletKind;
using coupled::OutletCondition;
using coupled::OutletKind;
using Loads = coupled::Loads<2>;
using Prescribed = coupled::Prescribed<2>;  ///< components (r, z)

/// Everything that is computed with: a vessel in the frame (r, theta, z), or its blood or its wall alone.
struct Problem : coupled::Conditions<2> {
  Mesh mesh;
};

}  // namespace tunica::axisym
