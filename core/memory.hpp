// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <new>
#include <optional>
#include <string>

namespace tunica {

inline constexpr double gib = 1024.0 * 1024 * 1024;

/// Memory that this process can still get, bytes: what the machine has available, or what a limit of the
/// process (ulimit -v) leaves when that is less. None where the system does not say.
std::optional<double> available_memory();

/// What operator new throws in programs that keep count of what is asked (app/allocation.cpp).
class OutOfMemory final : public std::bad_alloc {
 public:
  explicit OutOfMemory(std::size_t bytes) : bytes_(bytes) {}
  const char* what() const noexcept override { return "memory ran out"; }
  std::size_t bytes() const { return bytes_; }

 private:
  std::size_t bytes_;
};

/// That memory ran out: how much was asked for where that is known, how much is in use, the limit of the
/// process if it has one, and which keys ask for less. One line.
std::string memory_ran_out(const std::bad_alloc& error);

}  // namespace tunica
