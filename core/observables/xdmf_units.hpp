// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace tunica::observables {

/// What the Information that holds a field's unit is called, before the field's name. It belongs to the
/// domain, as do the planes of symmetry: an Attribute holds its numbers alone and the collection its grids,
/// which is what readers such as meshio's expect.
inline constexpr std::string_view xdmf_unit_of = "unit of ";

}  // namespace tunica::observables
