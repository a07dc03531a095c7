// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mpi.h>

#include <span>
#include <string>
#include <vector>

namespace tunica::full3d {

/// The processes that compute together. The first one leads: it holds the run and tells the others what to
/// do (see Team). All calls are collective.
class Ranks {
 public:
  Ranks() : Ranks(MPI_COMM_WORLD) {}
  explicit Ranks(MPI_Comm communicator);

  int rank() const { return rank_; }
  int size() const { return size_; }
  bool leads() const { return rank_ == 0; }
  MPI_Comm communicator() const { return communicator_; }
  /// Processes on this machine, which share its cores.
  int on_machine() const { return on_machine_; }

  /// From the leader to all.
  void broadcast(std::span<double> values) const;
  void broadcast(std::span<int> values) const;
  void broadcast(std::string& text) const;
  /// Sums over the ranks; the result is on the leader alone.
  void sum_to_leader(std::span<double> values) const;
  /// The same, with the result on all ranks.
  void sum_to_all(std::span<double> values) const;
  /// On all ranks, the same to the last bit.
  bool all(bool value) const;
  /// Ends the processes of all ranks, with an error.
  [[noreturn]] void abort() const;

 private:
  MPI_Comm communicator_;
  int rank_ = 0, size_ = 1, on_machine_ = 1;
};

}  // namespace tunica::full3d
