// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/scene/scene.hpp"

namespace {

[[noreturn]] void fail(std::string_view what, std::string_view detail) {
  std::cerr << what << ": " << detail << '\n';
  std::abort();
}

/// The text before the first byte 1 is the scene, what follows are overrides, each ended by another.
std::vector<std::string> split(std::string_view input) {
  std::vector<std::string> parts;
  for (std::size_t start = 0; start <= input.size();) {
    const std::size_t end = std::min(input.find('\x01', start), input.size());
    parts.emplace_back(input.substr(start, end - start));
    start = end + 1;
  }
  return parts;
}

}  // namespace

/// Any text makes a scene or an InvalidInput of one line; and a scene reads back from its description.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<std::string> overrides = split({reinterpret_cast<const char*>(data), size});
  const std::string text = overrides.front();
  overrides.erase(overrides.begin());
  try {
    const tunica::Scene scene = tunica::parse_scene(text, "fuzz.toml", TUNICA_SCENES, overrides);
    try {
      const tunica::Scene again = tunica::parse_scene(tunica::describe(scene), "fuzz.toml", TUNICA_SCENES);
      if (again.values() != scene.values()) fail("another scene is read back from", tunica::describe(scene));
    } catch (const tunica::InvalidInput& error) {
      fail("a scene's own description is refused", error.what());
    }
  } catch (const tunica::InvalidInput& error) {
    const std::string_view message = error.what();
    if (message.empty() || message.find_first_of("\r\n") != std::string_view::npos)
      fail("not one line", message);
  }
  return 0;
}
