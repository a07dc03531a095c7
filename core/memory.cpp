// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/memory.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <string_view>

namespace tunica {

namespace {

std::optional<double> limit_of_process() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return {};
  return static_cast<double>(limit.rlim_cur);
}

/// A line of /proc/self/status, bytes: "VmSize" and "VmRSS" are of now, "VmPeak" and "VmHWM" the most so far.
double status(std::string_view name) {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with(name) && line[name.size()] == ':')
      return 1024 * std::stod(line.substr(name.size() + 1));
  return 0;
}

std::string shown(double bytes) {
  constexpr double kib = 1024, mib = 1024 * kib;
  return bytes < 0.1 * mib   ? fmt::format("{:.3g} KiB", bytes / kib)
         : bytes < 0.1 * gib ? fmt::format("{:.3g} MiB", bytes / mib)
                             : fmt::format("{:.3g} GiB", bytes / gib);
}

}  // namespace

std::optional<double> available_memory() {
  std::optional<double> available;
  std::ifstream file("/proc/meminfo");
  std::string word;
  while (file >> word)
    if (word == "MemAvailable:") {
      double kilobytes = 0;
      if (file >> kilobytes) available = 1024 * kilobytes;
      break;
    }
  if (const auto limit = limit_of_process()) {
    const double left = std::max(0.0, *limit - status("VmSize"));
    available = available ? std::min(*available, left) : left;
  }
  return available;
}

std::string memory_ran_out(const std::bad_alloc& error) {
  const auto limit = limit_of_process();
  const auto* counted = dynamic_cast<const OutOfMemory*>(&error);
  // When this is asked for what was in use may have been given back.
  return fmt::format(
      "memory ran out{} with {} in use{}; ask for fewer cells (mesh.*_cells, accuracy.tolerance), rows "
      "(output.interval) or pictures (output.field_interval)",
      counted ? fmt::format(" when {} more were asked for,", shown(static_cast<double>(counted->bytes())))
              : "",
      shown(status(limit ? "VmPeak" : "VmHWM")),
      limit ? fmt::format(", of {} that a limit lets the program have (ulimit -v)", shown(*limit)) : "");
}

}  // namespace tunica
