// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <toml++/toml.h>

#include <string>

#include "core/scene/parameter.hpp"

namespace tunica::scene {

/// The value of a TOML node as its parameter declares it: kind, unit, bounds and choices checked.
/// Throws InvalidInput: "key = value ...: what is allowed", without the place.
Value typed_value(const toml::node& node, const Parameter& parameter, const std::string& key);

/// A node as a scene file would write it, for messages: "3", "\"ica\"", "(a table)".
std::string shown(const toml::node& node);

}  // namespace tunica::scene
