// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/ranks.hpp"

#include <cstdlib>

#include "full3d/petsc.hpp"

namespace tunica::full3d {

Ranks::Ranks(MPI_Comm communicator) : communicator_(communicator) {
  check_mpi(MPI_Comm_rank(communicator_, &rank_), "MPI_Comm_rank");
  check_mpi(MPI_Comm_size(communicator_, &size_), "MPI_Comm_size");
  MPI_Comm machine;
  check_mpi(MPI_Comm_split_type(communicator_, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine),
            "MPI_Comm_split_type");
  check_mpi(MPI_Comm_size(machine, &on_machine_), "MPI_Comm_size");
  check_mpi(MPI_Comm_free(&machine), "MPI_Comm_free");
}

void Ranks::broadcast(std::span<double> values) const {
  check_mpi(MPI_Bcast(values.data(), static_cast<int>(values.size()), MPI_DOUBLE, 0, communicator_),
            "MPI_Bcast");
}

void Ranks::broadcast(std::span<int> values) const {
  check_mpi(MPI_Bcast(values.data(), static_cast<int>(values.size()), MPI_INT, 0, communicator_),
            "MPI_Bcast");
}

void Ranks::broadcast(std::string& text) const {
  int length = static_cast<int>(text.size());
  broadcast(std::span<int>(&length, 1));
  text.resize(length);
  check_mpi(MPI_Bcast(text.data(), length, MPI_CHAR, 0, communicator_), "MPI_Bcast");
}

void Ranks::sum_to_leader(std::span<double> values) const {
  if (size_ == 1) return;
  check_mpi(MPI_Reduce(leads() ? MPI_IN_PLACE : values.data(), leads() ? values.data() : nullptr,
                       static_cast<int>(values.size()), MPI_DOUBLE, MPI_SUM, 0, communicator_),
            "MPI_Reduce");
}

void Ranks::sum_to_all(std::span<double> values) const {
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_SUM,
                          communicator_),
            "MPI_Allreduce");
}

bool Ranks::all(bool value) const {
  int mine = value ? 1 : 0, least = 0;
  check_mpi(MPI_Allreduce(&mine, &least, 1, MPI_INT, MPI_MIN, communicator_), "MPI_Allreduce");
  return least != 0;
}

void Ranks::abort() const {
  static_cast<void>(MPI_Abort(communicator_, 3));
  std::abort();
}

}  // namespace tunica::full3d
