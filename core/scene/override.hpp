// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <toml++/toml.h>

#include <string>

#include "core/scene/given.hpp"

namespace tunica::scene {

/// Puts the value of "key=value" into the tree, replacing what the file says. The value is read as
/// TOML, or as plain text where it is none, so that wall.law=EXP1 and tether.stiffness=1e7 dyn/cm3
/// need no quotes. Throws InvalidInput (one line) for a key that is not declared or a table that the
/// file has not.
void apply_override(toml::table& root, const std::string& text, const std::string& label);

/// Does the same to values that have been read, for a plain number of a key that is in no array of tables.
/// False, with nothing done, for anything else. Throws InvalidInput for a number that the key does not allow.
bool apply_number(GivenScene& given, const std::string& text);

}  // namespace tunica::scene
