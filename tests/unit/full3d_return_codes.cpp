// SPDX-License-Identifier: GPL-3.0-or-later
// What MPI and PETSc report ends as one line that names the call.
#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "full3d/petsc.hpp"
#include "full3d/ranks.hpp"

namespace tunica::full3d {
namespace {

std::string complaint_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

// Also run by two processes, which both end.
TEST(ReturnCodes, OfMpiNameTheCallAndTheReason) {
  const std::string complaint = complaint_of([] { const Ranks nobody(MPI_COMM_NULL); });
  EXPECT_EQ(complaint.find("MPI_Comm_rank: "), 0U) << complaint;
  EXPECT_NE(complaint.find("invalid communicator"), std::string::npos) << complaint;
}

TEST(ReturnCodes, OfMpiAreThoseOfTheCallThatFailed) {
  std::vector<double> one(1);
  EXPECT_EQ(complaint_of([&] {
              check_mpi(MPI_Bcast(one.data(), -1, MPI_DOUBLE, 0, MPI_COMM_SELF), "MPI_Bcast");
            }).find("MPI_Bcast: MPI_ERR_COUNT"),
            0U);
  EXPECT_EQ(
      complaint_of([&] { check_mpi(MPI_Bcast(one.data(), 1, MPI_DOUBLE, 0, MPI_COMM_WORLD), "MPI_Bcast"); }),
      "");
}

TEST(ReturnCodes, OfPetscNameTheCallAndTheReason) {
  OwnedVector vector;
  check(VecCreateSeq(PETSC_COMM_SELF, 2, vector.put()), "VecCreateSeq");
  const std::string complaint =
      complaint_of([&] { check(VecSetType(vector.get(), "no such type"), "VecSetType"); });
  EXPECT_EQ(complaint.find("VecSetType: "), 0U) << complaint;
  EXPECT_NE(complaint.find("no such type"), std::string::npos) << complaint;
}

}  // namespace
}  // namespace tunica::full3d
