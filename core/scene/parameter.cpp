// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scene/parameter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "core/scene/message.hpp"

namespace tunica::scene {

namespace {

/// A key as it is declared, and the indices that were in its brackets.
struct Pattern {
  std::string key;
  std::vector<std::string> indices;
};

/// Takes the digits out of "[12]"; brackets that hold anything else stay as they are and match nothing.
Pattern pattern_of(std::string_view key) {
  Pattern pattern;
  for (std::size_t i = 0; i < key.size(); ++i) {
    pattern.key += key[i];
    if (key[i] != '[') continue;
    std::size_t end = i + 1;
    while (end < key.size() && std::isdigit(static_cast<unsigned char>(key[end]))) ++end;
    if (end < key.size() && key[end] == ']') {
      pattern.indices.emplace_back(key.substr(i + 1, end - i - 1));
      i = end - 1;
    }
  }
  return pattern;
}

std::string with_indices(const std::string& declared, const std::vector<std::string>& indices) {
  std::string key;
  std::size_t next = 0;
  for (const char letter : declared) {
    if (letter == ']') key += next < indices.size() ? indices[next++] : "0";
    key += letter;
  }
  return key;
}

std::string_view leaf_of(std::string_view key) {
  return key.substr(key.rfind('.') + 1);
}

}  // namespace

bool Bounds::contains(double value) const {
  if (!std::isfinite(value)) return false;
  return (lower_open ? value > lower : value >= lower) && (upper_open ? value < upper : value <= upper);
}

std::string Bounds::text() const {
  const bool from = std::isfinite(lower);
  const bool to = std::isfinite(upper);
  if (!from && !to) return "any finite number";
  if (!from) return upper_open ? fmt::format("< {:g}", upper) : fmt::format("{:g} or less", upper);
  if (!to) return lower_open ? fmt::format("> {:g}", lower) : fmt::format("{:g} or more", lower);
  if (!lower_open && !upper_open) return fmt::format("{:g} to {:g}", lower, upper);
  return fmt::format("{} {:g}, {} {:g}", lower_open ? ">" : "at least", lower, upper_open ? "<" : "at most",
                     upper);
}

std::string declared_form(std::string_view key) {
  return pattern_of(key).key;
}

const Parameter* find_parameter(std::string_view key) {
  static const auto index = [] {
    std::map<std::string, const Parameter*, std::less<>> by_key;
    for (const Parameter& parameter : parameters()) by_key.emplace(parameter.key, &parameter);
    return by_key;
  }();
  const auto entry = index.find(declared_form(key));
  return entry == index.end() ? nullptr : entry->second;
}

std::string nearest_key(std::string_view key) {
  constexpr std::size_t longest_key = 200;
  if (key.empty() || key.size() > longest_key) return {};
  const Pattern pattern = pattern_of(key);
  const std::string_view leaf = leaf_of(pattern.key);

  struct Candidate {
    int rank;
    std::size_t distance;
    const Parameter* parameter;
  };
  // A slip of the finger in the whole key is likelier than the right name in a wrong table, and that
  // is likelier than several slips.
  enum { slip, wrong_table, several_slips, slip_and_wrong_table, none };
  Candidate best{none, longest_key, nullptr};
  for (const Parameter& parameter : parameters()) {
    const std::string_view other_leaf = leaf_of(parameter.key);
    const std::size_t distance = edit_distance(pattern.key, parameter.key);
    const std::size_t leaf_distance = edit_distance(leaf, other_leaf);
    const int rank = distance <= 2                                                        ? slip
                     : leaf_distance == 0                                                 ? wrong_table
                     : distance <= std::max(pattern.key.size(), parameter.key.size()) / 3 ? several_slips
                     : leaf_distance <= std::max(leaf.size(), other_leaf.size()) / 3 ? slip_and_wrong_table
                                                                                     : none;
    if (rank < best.rank || (rank == best.rank && rank != none && distance < best.distance))
      best = {rank, distance, &parameter};
  }
  return best.parameter ? with_indices(best.parameter->key, pattern.indices) : std::string{};
}

}  // namespace tunica::scene
