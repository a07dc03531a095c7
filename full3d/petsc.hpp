// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// PETSc's headers wrap calls of MPI in macros that count them, some of which make 0 or 1 of the code that is
// returned. This is the headers' own switch against it.
#define PETSC_HAVE_BROKEN_RECURSIVE_MACRO 1
#include <petscksp.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace tunica::full3d {

/// A call of PETSc that failed.
class PetscFailure : public std::runtime_error {
 public:
  PetscFailure(const std::string& message, PetscErrorCode code) : std::runtime_error(message), code_(code) {}
  PetscErrorCode code() const { return code_; }

 private:
  PetscErrorCode code_;
};

/// Throws PetscFailure naming the call of PETSc that failed and its reason, in one line.
void check(PetscErrorCode code, const char* call);

/// Of MPI in the same way. With several processes, which would wait for this one without end, it says so and
/// ends all of them, with exit code 3.
void check_mpi(int code, const char* call);

/// Owns an object of PETSc.
template <class Object, PetscErrorCode (*destroy)(Object*)>
class Owned {
 public:
  Owned() = default;
  ~Owned() {
    // A destructor has nobody to tell; what cannot be freed is memory until the program ends.
    if (object_) static_cast<void>(destroy(&object_));
  }
  Owned(Owned&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  Owned& operator=(Owned&& other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }
  Object get() const { return object_; }
  /// To be filled by a call that creates it; nothing must be owned yet.
  Object* put() { return &object_; }
  explicit operator bool() const { return object_ != nullptr; }

 private:
  Object object_ = nullptr;
};

using OwnedMatrix = Owned<Mat, MatDestroy>;
using OwnedVector = Owned<Vec, VecDestroy>;
using OwnedSolver = Owned<KSP, KSPDestroy>;
using OwnedIndices = Owned<IS, ISDestroy>;
using OwnedNullSpace = Owned<MatNullSpace, MatNullSpaceDestroy>;
using OwnedPartitioning = Owned<MatPartitioning, MatPartitioningDestroy>;

/// PETSc and MPI for as long as it lives: one in a program. PETSc's own options come from the environment
/// (PETSC_OPTIONS) and from what the program gives. Errors of both come back as codes.
class PetscSession {
 public:
  PetscSession();
  ~PetscSession();
  PetscSession(const PetscSession&) = delete;
  PetscSession& operator=(const PetscSession&) = delete;
};

}  // namespace tunica::full3d
