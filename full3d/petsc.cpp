// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/petsc.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace tunica::full3d {

void check(PetscErrorCode code, const char* call) {
  if (code == 0) return;
  const char* general = nullptr;
  char* particular = nullptr;
  if (PetscErrorMessage(code, &general, &particular) != 0) general = nullptr;
  // What PETSC says of the case may be of several lines, of which the first has the matter.
  std::string text = particular ? particular : "";
  text = text.substr(0, text.find('\n'));
  if (text.empty()) text = general ? general : "failed";
  throw PetscFailure(fmt::format("{}: {}", call, text), code);
}

void check_mpi(int code, const char* call) {
  if (code == MPI_SUCCESS) return;
  std::array<char, MPI_MAX_ERROR_STRING> text{};
  int length = 0, rank = 0, size = 1;
  const bool told = MPI_Error_string(code, text.data(), &length) == MPI_SUCCESS;
  const std::string message =
      fmt::format("{}: {}", call, told ? std::string(text.data(), length) : fmt::format("code {}", code));
  const bool known = MPI_Comm_rank(MPI_COMM_WORLD, &rank) == MPI_SUCCESS &&
                     MPI_Comm_size(MPI_COMM_WORLD, &size) == MPI_SUCCESS;
  if (known && size == 1) throw std::runtime_error(message);
  fmt::print(stderr, "tunica: rank {} of {}: {}; all ranks end here\n", rank, size, message);
  static_cast<void>(MPI_Abort(MPI_COMM_WORLD, 3));
  std::abort();
}

PetscSession::PetscSession() {
  check(PetscInitializeNoArguments(), "PetscInitialize");
  // Left to themselves both libraries print pages and end the program; check() and check_mpi() say in a line
  // which call failed. A communicator made of these two has their handler.
  check(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr), "PetscPushErrorHandler");
  for (const MPI_Comm communicator : {MPI_COMM_WORLD, MPI_COMM_SELF})
    check_mpi(MPI_Comm_set_errhandler(communicator, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
}

PetscSession::~PetscSession() {
  if (PetscFinalize() != 0) fmt::print(stderr, "tunica: PetscFinalize failed\n");
}

}  // namespace tunica::full3d
