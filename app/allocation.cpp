// SPDX-License-Identifier: GPL-3.0-or-later
// operator new of the programs: as it is by default, but for the number of bytes in what it throws, so that
// who runs out of memory learns how much was asked for. Both new and delete are replaced, as instruments that
// watch memory want a pair.
#include <cstdlib>
#include <new>

#include "core/memory.hpp"

void* operator new(std::size_t bytes) {
  if (void* memory = std::malloc(bytes == 0 ? 1 : bytes)) return memory;
  throw tunica::OutOfMemory(bytes);
}
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  return std::malloc(bytes == 0 ? 1 : bytes);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, const std::nothrow_t&) noexcept {
  std::free(memory);
}
