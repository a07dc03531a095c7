// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/launch.hpp"

#include <cstdlib>
#include <string_view>

namespace tunica {

bool is_first_process() {
  // Open MPI; MPICH and its kin; Slurm.
  for (const char* variable : {"OMPI_COMM_WORLD_RANK", "PMI_RANK", "SLURM_PROCID"})
    if (const char* rank = std::getenv(variable)) return std::string_view(rank) == "0";
  return true;
}

}  // namespace tunica
