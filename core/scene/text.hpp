// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace tunica::scene {

/// The bytes of an input file. `what` names its role in messages ("scene", "waveform"), `extension`
/// is that of the files to suggest when there is none of that name.
/// Throws InvalidInput when it is missing, a folder, unreadable or larger than `largest` bytes.
std::string load_text(const std::filesystem::path& file, std::string_view what, std::string_view extension,
                      std::size_t largest);

/// The largest scene file that is read: a scene of a hundred layers takes a hundredth of it.
constexpr std::size_t largest_scene = 4'000'000;

/// Refuses text that is no scene before a parser sees it: empty, binary, too large, or keys of so many
/// dotted parts that the tables nested in each other would exhaust the stack.
void check_scene_text(std::string_view text, const std::string& label);

}  // namespace tunica::scene
