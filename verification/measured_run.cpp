// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/measured_run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace tunica::verification {

namespace {

struct Ended {
  int status;
  rusage usage;
};

Ended run_to_end(const std::vector<std::string>& arguments) {
  std::vector<std::string> texts = arguments;
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  pid_t child = -1;
  if (const int error = ::posix_spawn(&child, pointers[0], nullptr, nullptr, pointers.data(), environ))
    throw std::runtime_error(fmt::format("{} cannot be started: {}", arguments[0], std::strerror(error)));
  Ended ended{};
  if (::wait4(child, &ended.status, 0, &ended.usage) != child)
    throw std::runtime_error(fmt::format("{} was lost", arguments[0]));
  return ended;
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

long MeasuredRun::count(const char* key) const {
  if (const auto own = stored.record.find(key); own != stored.record.end()) return own->get<long>();
  const auto& resolution = stored.record.at("resolution");
  return resolution.contains(key) ? resolution.at(key).get<long>() : 0;
}

MeasuredRun measured_run(const std::filesystem::path& program, const std::filesystem::path& scene,
                         const std::string& tier, const std::vector<std::string>& overrides,
                         const std::filesystem::path& folder, Folder earlier) {
  std::vector<std::string> arguments{program.string(), "run",           scene.string(), "--tier", tier,
                                     "--out",          folder.string(), "--quiet"};
  if (earlier == Folder::resumed) arguments.emplace_back("--resume");
  for (const std::string& override : overrides) {
    arguments.emplace_back("--set");
    arguments.push_back(override);
  }
  const auto began = std::chrono::steady_clock::now();
  const Ended ended = run_to_end(arguments);
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  if (!WIFEXITED(ended.status) || WEXITSTATUS(ended.status) != 0)
    throw std::runtime_error(fmt::format("{} failed", fmt::join(arguments, " ")));
  // Linux counts the resident set in KiB.
  return {read_result(folder), wall, seconds(ended.usage.ru_utime) + seconds(ended.usage.ru_stime),
          static_cast<double>(ended.usage.ru_maxrss) / 1024};
}

double error_of(const std::string& column, const MeasuredRun& run, const MeasuredRun& reference) {
  const auto values = [](const MeasuredRun& of, const std::string& name) -> const std::vector<double>& {
    const observables::Column* found = of.stored.result.observables.find(name);
    if (!found) throw std::runtime_error("observables without " + name);
    return found->values;
  };
  if (values(run, "time") != values(reference, "time"))
    throw std::runtime_error("runs with rows at different times cannot be compared");
  const auto& ours = values(run, column);
  const auto& theirs = values(reference, column);
  const auto [least, greatest] = std::minmax_element(theirs.begin(), theirs.end());
  double largest = 0;
  for (std::size_t k = 0; k < theirs.size(); ++k) largest = std::max(largest, std::abs(ours[k] - theirs[k]));
  if (observables::is_none(*least) || !(*greatest > *least)) return observables::none;
  return largest / (*greatest - *least);
}

double event_difference(const MeasuredRun& run, const MeasuredRun& reference) {
  const auto* ours = run.stored.result.events.find("time");
  const auto* theirs = reference.stored.result.events.find("time");
  if (!ours || !theirs || theirs->values.empty()) return observables::none;
  if (ours->values.size() != theirs->values.size()) return INFINITY;
  double greatest = 0;
  for (std::size_t k = 0; k < ours->values.size(); ++k)
    greatest = std::max(greatest, std::abs(ours->values[k] - theirs->values[k]));
  return greatest;
}

}  // namespace tunica::verification
