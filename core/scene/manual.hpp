// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace tunica::scene {

/// docs/parameters.md: every parameter of a scene with unit, default, allowed values and meaning, and
/// every law with its own defaults, in Markdown.
std::string manual();

}  // namespace tunica::scene
