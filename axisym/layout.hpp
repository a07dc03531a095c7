// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "axisym/problem.hpp"
#include "core/coupled/layout.hpp"

namespace tunica::axisym {

using coupled::Layout;

/// The layout of a problem's state.
Layout layout_of(const Problem& problem);

}  // namespace tunica::axisym
