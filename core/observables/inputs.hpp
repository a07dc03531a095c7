// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "core/scene/scene.hpp"

namespace tunica {

/// FNV-1a, 64 bits: tells chance damage and edits, and is not meant to withstand anyone.
std::uint64_t checksum(std::string_view bytes);

/// Whatever else than the scene's values decides what is computed: the checksum, as hexadecimal text, of each
/// file that the scene names, by the file's key ("inlet.waveform", "geometry.file").
nlohmann::ordered_json input_files(const Scene& scene);

/// What has changed since a run kept the scene's text (describe) and its files (input_files): the file, or
/// the scene and its first key, as in "the contents of inlet.waveform = \"flow.csv\" have changed" and
/// "cylinder.toml: geometry.radius was 0.4 and is 0.5". Empty when nothing has. `files` are those of
/// now.
std::string changed_input(const Scene& scene, const nlohmann::ordered_json& files, std::string_view kept_toml,
                          const nlohmann::ordered_json& kept_files);

}  // namespace tunica
