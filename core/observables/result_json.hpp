// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/observables/result.hpp"

namespace tunica::json {

static_assert(std::endian::native == std::endian::little, "binary values are stored little-endian");

/// Numbers as one binary value, bit by bit; CBOR keeps it as it is.
template <class Range>
nlohmann::json binary(const Range& range) {
  const std::span values(range);
  static_assert(std::is_trivially_copyable_v<typename decltype(values)::element_type>);
  std::vector<std::uint8_t> bytes(values.size_bytes());
  if (!bytes.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return nlohmann::json::binary(std::move(bytes));
}

/// What binary() was given. Throws std::logic_error for another value.
template <class T>
std::vector<T> numbers(const nlohmann::json& value) {
  if (!value.is_binary() || value.get_binary().size() % sizeof(T) != 0)
    throw std::logic_error("a packed array was expected");
  const auto& bytes = value.get_binary();
  std::vector<T> values(bytes.size() / sizeof(T));
  if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

/// A result with everything in it, fields and record included, and back.
nlohmann::json from_result(const Result& result);
Result to_result(const nlohmann::json& value);

}  // namespace tunica::json
