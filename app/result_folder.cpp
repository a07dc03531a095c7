// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/result_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <map>
#include <string_view>

#include "core/observables/inputs.hpp"

namespace tunica {

namespace {

std::string without_blanks_around(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1));
}

/// The overrides as the command means them, in an order that does not depend on it.
std::map<std::string, std::string> by_key(const std::vector<std::string>& overrides) {
  std::map<std::string, std::string> values;
  for (const std::string& text : overrides) {
    const auto equals = std::min(text.find('='), text.size());
    values[without_blanks_around(std::string_view(text).substr(0, equals))] =
        equals < text.size() ? without_blanks_around(std::string_view(text).substr(equals + 1)) : "";
  }
  return values;
}

char plain(char letter) {
  const bool is_plain = std::isalnum(static_cast<unsigned char>(letter)) != 0 ||
                        std::string_view("._+-=%,").find(letter) != std::string_view::npos;
  return is_plain ? letter : '_';
}

}  // namespace

std::filesystem::path result_folder(const std::string& name, const std::vector<std::string>& parts,
                                    const std::vector<std::string>& overrides) {
  std::string behind;
  for (const std::string& part : parts) behind += '-' + part;
  for (const auto& [key, value] : by_key(overrides)) behind += fmt::format("-{}={}", key, value);
  std::string shown = behind;
  std::transform(shown.begin(), shown.end(), shown.begin(), plain);
  std::string whole = name + shown;
  constexpr std::size_t longest = 120, digits = 9;
  if (shown != behind || (!shown.empty() && whole.size() > longest)) {
    whole.resize(std::min(whole.size(), longest - digits));
    whole += fmt::format("-{:08x}", static_cast<std::uint32_t>(checksum(name + behind)));
  }
  return std::filesystem::path("results") / whole;
}

}  // namespace tunica
