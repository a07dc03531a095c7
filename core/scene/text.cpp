// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scene/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <map>
#include <system_error>
#include <vector>

#include "core/error.hpp"
#include "core/scene/message.hpp"

namespace tunica::scene {

namespace {

namespace fs = std::filesystem;

/// The file that was probably meant, or else what there is to choose from.
std::string suggest_file(const fs::path& missing, std::string_view extension) {
  const fs::path folder = missing.has_parent_path() ? missing.parent_path() : fs::path(".");
  std::map<std::string, std::string> file_of_stem;
  std::vector<std::string> stems;
  std::error_code error;
  // Few enough entries to be read at once, however large the folder is.
  constexpr std::size_t most_entries = 1000;
  std::size_t entries = 0;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end && entries < most_entries;
       entry.increment(error), ++entries) {
    if (entry->path().extension() != extension) continue;
    const std::string stem = entry->path().stem().string();
    stems.push_back(stem);
    file_of_stem[stem] = (missing.parent_path() / entry->path().filename()).string();
  }
  std::sort(stems.begin(), stems.end());
  const std::string stem = nearest(missing.stem().string(), stems);
  if (!stem.empty()) return did_you_mean(one_line(file_of_stem[stem]));
  if (stems.empty()) return fmt::format("; there is no *{} file in that folder", extension);
  return fmt::format("; there is {} in that folder",
                     one_line(fs::path(file_of_stem[stems.front()]).filename().string()));
}

bool bare_key_letter(char letter) {
  return std::isalnum(static_cast<unsigned char>(letter)) || letter == '_' || letter == '-';
}

/// Where the string that opens at `start` ends (one past its closing quotes).
std::size_t end_of_string(std::string_view text, std::size_t start) {
  const char quote = text[start];
  const bool multiline = text.substr(start, 3) == std::string(3, quote);
  const std::size_t closing = multiline ? 3 : 1;
  for (std::size_t i = start + closing; i < text.size(); ++i) {
    if (text[i] == '\\' && quote == '"')
      ++i;
    else if (!multiline && text[i] == '\n')
      return i;
    else if (text[i] == quote && (!multiline || text.substr(i, 3) == text.substr(start, 3)))
      return i + closing;
  }
  return text.size();
}

/// The most parts that any dotted key of the text has; an upper bound is enough, so numbers count too.
std::size_t most_dotted_parts(std::string_view text) {
  std::size_t most = 0;
  std::size_t parts = 0;
  for (std::size_t i = 0; i < text.size();) {
    const char letter = text[i];
    if (letter == '"' || letter == '\'') {
      i = end_of_string(text, i);
      continue;
    }
    if (letter == '#') {
      i = std::min(text.find('\n', i), text.size());
      continue;
    }
    if (letter == '.')
      most = std::max(most, ++parts);
    else if (!bare_key_letter(letter) && letter != ' ' && letter != '\t')
      parts = 0;
    ++i;
  }
  return most + 1;
}

}  // namespace

std::string load_text(const fs::path& file, std::string_view what, std::string_view extension,
                      std::size_t largest) {
  const std::string label = one_line(file.string(), 400);
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found)
    throw InvalidInput(fmt::format("the {} file {} does not exist{}", what, label.empty() ? "\"\"" : label,
                                   suggest_file(file, extension)));
  if (status.type() == fs::file_type::directory)
    throw InvalidInput(fmt::format("{} is a folder; name a {} file (*{}) in it", label, what, extension));
  if (error)
    throw InvalidInput(fmt::format("the {} file {} cannot be read: {}", what, label, error.message()));
  if (status.type() != fs::file_type::regular)
    throw InvalidInput(fmt::format("{} is not a regular file; name a {} file (*{})", label, what, extension));

  const auto size = fs::file_size(file, error);
  if (!error && size > largest)
    throw InvalidInput(fmt::format("the {} file {} has {} bytes; a {} file has at most {}", what, label, size,
                                   what, largest));
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::string text(error ? 0 : static_cast<std::size_t>(size), '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!stream)
    throw InvalidInput(fmt::format("the {} file {} cannot be read ({}); check its permissions", what, label,
                                   std::strerror(errno)));
  return text;
}

void check_scene_text(std::string_view text, const std::string& label) {
  if (text.size() > largest_scene)
    throw InvalidInput(
        fmt::format("{} has {} bytes; a scene has at most {}", label, text.size(), largest_scene));
  if (text.find('\0') != std::string_view::npos)
    throw InvalidInput(
        fmt::format("{} is a binary file; a scene is TOML text, for example scenes/cylinder.toml", label));
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos)
    throw InvalidInput(fmt::format("{} is empty; write at least one table, for example [geometry]", label));
  constexpr std::size_t most_parts = 16;
  if (most_dotted_parts(text) > most_parts)
    throw InvalidInput(
        fmt::format("{} has a key of more than {} dotted parts; keys have at most four, for example "
                    "wall.layers[0].stiffness",
                    label, most_parts));
}

}  // namespace tunica::scene
