// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/observables/result.hpp"
#include "core/scene/scene.hpp"

namespace tunica {

/// Where a run stood, enough to go on from there as if it had never stopped.
struct Checkpoint {
  nlohmann::json state = nlohmann::json::object();  ///< the tier's own: numbers as they are, arrays by pack()
  Result so_far;  ///< tables, fields and record up to here; its seconds count the time spent
};

/// Numbers as one binary value, to the last bit (NaN, infinities and signed zeros included).
nlohmann::json pack(std::span<const double> values);
/// What pack() was given. Throws std::logic_error for a value that is not of pack().
std::vector<double> unpack(const nlohmann::json& packed);

/// Writes FOLDER/checkpoint: CBOR, aside and renamed (write_whole), with the program's version and commit,
/// the tier, the scene's whole text, its files (input_files, as they were when the run began), and a checksum
/// of the contents. Throws OutputFailure.
void write_checkpoint(const std::filesystem::path& folder, const Scene& scene, std::string_view tier,
                      const nlohmann::ordered_json& files, const Checkpoint& checkpoint);

/// Reads it back. Throws InvalidInput, naming the remedy, when it is cut off or damaged, or was written by
/// another version of the program, for another scene (or other contents of a file that it names) or by
/// another tier.
Checkpoint read_checkpoint(const std::filesystem::path& folder, const Scene& scene, std::string_view tier);

/// What the checkpoint in the folder belongs to when that is not a run of this scene and tier: "it is of tier
/// full3d", "cylinder.toml: geometry.radius was 0.4 and is 0.5". Empty when it is theirs, or is damaged, and
/// without one.
std::string other_checkpoint(const std::filesystem::path& folder, const Scene& scene, std::string_view tier);

bool has_checkpoint(const std::filesystem::path& folder);
/// Throws OutputFailure when it is there and cannot be removed.
void remove_checkpoint(const std::filesystem::path& folder);

}  // namespace tunica
