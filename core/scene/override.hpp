// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <toml++/toml.h>

#include <string>

namespace tunica::scene {

/// Puts the value of "key=value" into the tree, replacing what the file says. The value is read as
/// TOML, or as plain text where it is none, so that wall.law=EXP1 and tether.stiffness=1e7 dyn/cm3
/// need no quotes. Throws InvalidInput (one line) for a key that is not declared or a table that the
/// file has not.
void apply_override(toml::table& root, const std::string& text, const std::string& label);

}  // namespace tunica::scene
