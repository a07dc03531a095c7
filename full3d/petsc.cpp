// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/petsc.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace tunica::full3d {

void check(PetscErrorCode code, const char* call) {
  if (code == 0) return;
  const char* text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  throw std::runtime_error(fmt::format("{}: {}", call, text ? text : "failed"));
}

PetscSession::PetscSession() {
  check(PetscInitializeNoArguments(), "PetscInitialize");
  // Errors come back as codes, which check() turns into exceptions with the name of the call.
  check(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr), "PetscPushErrorHandler");
}

PetscSession::~PetscSession() {
  PetscFinalize();
}

}  // namespace tunica::full3d
