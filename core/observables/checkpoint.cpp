// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/observables/checkpoint.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <fstream>
#include <iterator>
#include <system_error>

#include "core/error.hpp"
#include "core/observables/build_info.hpp"
#include "core/observables/result_json.hpp"

namespace tunica {

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

constexpr const char* file_name = "checkpoint";
constexpr const char* remedy =
    "leave out --resume to compute from the beginning, or name another folder with --out";

/// FNV-1a: tells chance damage, and is not meant to withstand anyone.
std::uint64_t checksum(std::string_view bytes) {
  std::uint64_t sum = 14695981039346656037U;
  for (const char byte : bytes) {
    sum ^= static_cast<unsigned char>(byte);
    sum *= 1099511628211U;
  }
  return sum;
}

std::string_view view(const std::vector<std::uint8_t>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string contents(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// Whatever else than the scene's values decides what is computed: files that it names.
Json input_files(const Scene& scene) {
  Json files = Json::object();
  for (const auto& [key, value] : scene.values()) {
    const auto* name = std::get_if<std::string>(&value);
    std::error_code no_file;
    if (name && !name->empty() && fs::is_regular_file(scene.folder() / *name, no_file))
      files[key] = checksum(contents(scene.folder() / *name));
  }
  return files;
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
                      const Checkpoint& checkpoint) {
  const std::vector<std::uint8_t> body =
      Json::to_cbor({{"state", checkpoint.state}, {"so_far", json::from_result(checkpoint.so_far)}});
  const std::vector<std::uint8_t> whole = Json::to_cbor({{"program", program()},
                                                         {"tier", tier},
                                                         {"scene", describe(scene)},
                                                         {"files", input_files(scene)},
                                                         {"checksum", checksum(view(body))},
                                                         {"body", Json::binary(body)}});
  write_whole(folder / file_name, view(whole));
}

Checkpoint read_checkpoint(const fs::path& folder, const Scene& scene, std::string_view tier) {
  const fs::path file = folder / file_name;
  const auto refuse = [&](const std::string& what) {
    throw InvalidInput(fmt::format("{}: {}; {}", file.string(), what, remedy));
  };
  constexpr bool strict = true, throwing = false;
  const Json whole = Json::from_cbor(contents(file), strict, throwing);
  const auto text = [&](const char* key) { return whole.value(key, std::string()); };
  try {
    if (!whole.is_object() || !whole.at("body").is_binary() ||
        whole.at("checksum") != checksum(view(whole.at("body").get_binary())))
      refuse("the checkpoint is cut off or damaged");
    if (text("program") != program())
      refuse(fmt::format("the checkpoint was written by tunica {}, this is {}", text("program"), program()));
    if (text("tier") != tier) refuse(fmt::format("the checkpoint is of tier {}, not {}", text("tier"), tier));
    if (text("scene") != describe(scene)) refuse("the checkpoint is of another scene");
    if (whole.at("files") != input_files(scene))
      refuse("a file that the scene names has changed since the checkpoint was written");
    const Json body = Json::from_cbor(whole.at("body").get_binary());
    return {body.at("state"), json::to_result(body.at("so_far"))};
  } catch (const Json::exception&) {
    refuse("the checkpoint is cut off or damaged");
    throw;
  }
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
