// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "core/scene/parameter.hpp"

namespace tunica::scene {

/// Text that is safe inside a one-line message: control characters and bytes that are not UTF-8 are
/// written as \xNN, and what is longer than `longest` characters is cut and ended by "...".
std::string one_line(std::string_view text, std::size_t longest = 100);

/// one_line() between double quotes.
std::string in_quotes(std::string_view text);

/// The number of insertions, deletions, replacements and swaps of neighbours between two words
/// (optimal string alignment), upper and lower case alike.
std::size_t edit_distance(std::string_view left, std::string_view right);

/// The word of `known` nearest to `word`, empty when none is within a third of its length.
std::string nearest(std::string_view word, std::span<const std::string> known);

/// `; did you mean X?`, or nothing when `suggestion` is empty.
std::string did_you_mean(std::string_view suggestion);

/// A value as a scene file would write it, for messages.
std::string shown(const Value& value);

/// A number with the unit of its key: "0.033 cm", "1.2".
std::string with_unit(double value, std::string_view unit);

}  // namespace tunica::scene
