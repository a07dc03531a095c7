// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/launch.hpp"

#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

namespace tunica {

namespace {

/// How launchers tell a process its number and how many there are. PMIX_RANK is not among them: it comes with
/// those of Open MPI, or from srun.
struct Launcher {
  const char *rank, *size;
};
constexpr Launcher launchers[] = {{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"},
                                  {"PMI_RANK", "PMI_SIZE"}};  // MPICH and its kin

std::string value_of(const char* variable) {
  const char* value = std::getenv(variable);
  return value ? value : "";
}

/// Whether the process that started this one has the variable with the same value: then it is the member of
/// the job, and this one its own doing. Launchers have it not, or the value of an outer job.
bool is_of_parent(const std::string& variable, const std::string& value) {
  std::ifstream file("/proc/" + std::to_string(::getppid()) + "/environ", std::ios::binary);
  const std::string environment{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  return ('\0' + environment).find('\0' + variable + '=' + value + '\0') != std::string::npos;
}

}  // namespace

bool is_first_process() {
  for (const auto& [rank_variable, size_variable] : launchers) {
    const std::string rank = value_of(rank_variable), size = value_of(size_variable);
    if (rank.empty() || rank == "0" || size.empty() || size == "1") continue;
    // srun gives the variables of MPICH to whatever it starts, also to commands that have nothing in common.
    if (value_of("SLURM_PROCID") == rank && rank_variable == launchers[1].rank) continue;
    if (!is_of_parent(rank_variable, rank)) return false;
  }
  return true;
}

}  // namespace tunica
