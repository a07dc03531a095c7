// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/observables/checkpoint.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <system_error>

#include "core/error.hpp"
#include "core/observables/build_info.hpp"
#include "core/observables/inputs.hpp"
#include "core/observables/result_json.hpp"

namespace tunica {

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

constexpr const char* file_name = "checkpoint";
constexpr const char* remedy =
    "leave out --resume to compute from the beginning, or name another folder with --out";
constexpr const char* remedy_for_another =
    "leave out --resume and write --replace to discard it, or name another folder with --out";

std::string_view view(const std::vector<std::uint8_t>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string contents(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// Of all that decides what a checkpoint belongs to and holds, but for the program.
std::uint64_t checksum_of(const Json& whole) {
  std::string bytes;
  for (const char* key : {"tier", "scene", "files"}) bytes += whole.at(key).get<std::string>();
  bytes += view(whole.at("body").get_binary());
  return checksum(bytes);
}

/// The checkpoint as it was written. A null when it is cut off or damaged.
Json whole_checkpoint(const fs::path& file) {
  constexpr bool strict = true, throwing = false;
  Json whole = Json::from_cbor(contents(file), strict, throwing);
  try {
    if (whole.is_object() && whole.at("body").is_binary() && whole.at("checksum") == checksum_of(whole))
      return whole;
  } catch (const Json::exception&) {
    // What is missing is damage too.
  }
  return {};
}

/// What has changed in the scene and its files since.
std::string change_since(const Json& whole, const Scene& scene) {
  return changed_input(scene, input_files(scene), whole.at("scene").get<std::string>(),
                       nlohmann::ordered_json::parse(whole.at("files").get<std::string>()));
}

std::string program() {
  return fmt::format("{} {}", program_version(), program_commit());
}

}  // namespace

Json pack(std::span<const double> values) {
  return json::binary(values);
}

std::vector<double> unpack(const Json& packed) {
  return json::numbers<double>(packed);
}

void write_checkpoint(const fs::path& folder, const Scene& scene, std::string_view tier,
                      const nlohmann::ordered_json& files, const Checkpoint& checkpoint) {
  const std::vector<std::uint8_t> body =
      Json::to_cbor({{"state", checkpoint.state}, {"so_far", json::from_result(checkpoint.so_far)}});
  Json whole = {{"program", program()},
                {"tier", tier},
                {"scene", describe(scene)},
                {"files", files.dump()},
                {"body", Json::binary(body)}};
  whole["checksum"] = checksum_of(whole);
  write_whole(folder / file_name, view(Json::to_cbor(whole)));
}

Checkpoint read_checkpoint(const fs::path& folder, const Scene& scene, std::string_view tier) {
  const fs::path file = folder / file_name;
  const auto refuse = [&](const std::string& what, const char* how_on = remedy) {
    throw InvalidInput(fmt::format("{}: {}; {}", file.string(), what, how_on));
  };
  const Json whole = whole_checkpoint(file);
  if (whole.is_null()) refuse("the checkpoint is cut off or damaged");
  const auto text = [&](const char* key) { return whole.value(key, std::string()); };
  try {
    if (text("program") != program())
      refuse(fmt::format("the checkpoint was written by tunica {}, this is {}", text("program"), program()));
    if (text("tier") != tier)
      refuse(fmt::format("the checkpoint is of tier {}, not {}", text("tier"), tier), remedy_for_another);
    const std::string change = change_since(whole, scene);
    if (!change.empty()) refuse("the checkpoint is of another scene: " + change, remedy_for_another);
    const Json body = Json::from_cbor(whole.at("body").get_binary());
    return {body.at("state"), json::to_result(body.at("so_far"))};
  } catch (const Json::exception&) {
    refuse("the checkpoint is cut off or damaged");
    throw;
  }
}

std::string other_checkpoint(const fs::path& folder, const Scene& scene, std::string_view tier) {
  if (!has_checkpoint(folder)) return {};
  const Json whole = whole_checkpoint(folder / file_name);
  if (whole.is_null()) return {};
  const std::string of_tier = whole.value("tier", std::string());
  return of_tier != tier ? "it is of tier " + of_tier : change_since(whole, scene);
}

bool has_checkpoint(const fs::path& folder) {
  std::error_code unreadable;
  return fs::exists(folder / file_name, unreadable);
}

void remove_checkpoint(const fs::path& folder) {
  std::error_code error;
  fs::remove(folder / file_name, error);
  if (error && has_checkpoint(folder))
    throw OutputFailure(
        fmt::format("{}: cannot be removed: {}", (folder / file_name).string(), error.message()));
}

}  // namespace tunica
