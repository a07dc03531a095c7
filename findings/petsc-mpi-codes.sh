#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# PETSc 3.18.5: with its headers included, MPI_Bcast returns 0 or 1 instead of MPI's code.
#
# petsclog.h counts messages by macros with the names of MPI's functions. MPI_Bcast and some others become
# "(count..., 0) || MPI_Bcast(...)", and || makes 1 of every code: a message that is too long (MPI_ERR_TRUNCATE)
# reads as a wrong buffer (MPI_ERR_BUFFER, which is 1). MPI_Allreduce beside it keeps its code. What helps: #define
# PETSC_HAVE_BROKEN_RECURSIVE_MACRO 1 before the headers, their own switch, or no calls of MPI where they are.
#
# The broadcast that fails is a function of the program's own, so that no MPI has to run.
# Needs gcc. Exits 0 while this is so, 1 when it has changed.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

apt-get download -qq -o APT::Sandbox::User=root libpetsc-real3.18-dev=3.18.5+dfsg1-1 libopenmpi-dev=4.1.4-3+b1
for package in *.deb; do dpkg -x "$package" .; done

cat > code.c <<'C'
#include <petscsys.h>
#include <stdio.h>
/* A broadcast that fails: what any MPI returns for a message that is too long. */
int(MPI_Bcast)(void* buffer, int count, MPI_Datatype type, int root, MPI_Comm communicator) {
  (void)buffer, (void)count, (void)type, (void)root, (void)communicator;
  return MPI_ERR_TRUNCATE;
}
int(MPI_Comm_size)(MPI_Comm communicator, int* size) {
  (void)communicator;
  *size = 2;
  return MPI_SUCCESS;
}
PetscLogDouble petsc_allreduce_ct = 0;
int main(void) {
  int value = 0;
  int through_petsc = MPI_Bcast(&value, 1, (MPI_Datatype)0, 0, (MPI_Comm)0);
  int as_it_is = (MPI_Bcast)(&value, 1, (MPI_Datatype)0, 0, (MPI_Comm)0);
  printf("returned by MPI_Bcast: %s\n", as_it_is == MPI_ERR_TRUNCATE ? "MPI_ERR_TRUNCATE" : "another code");
  printf("seen by its caller: %s\n", through_petsc == MPI_ERR_TRUNCATE ? "MPI_ERR_TRUNCATE"
                                     : through_petsc == MPI_ERR_BUFFER ? "MPI_ERR_BUFFER"
                                                                       : "another code");
  return 0;
}
C
includes="-Iusr/lib/petscdir/petsc3.18/x86_64-linux-gnu-real/include -Iusr/lib/x86_64-linux-gnu/openmpi/include"
# shellcheck disable=SC2086  # two words
gcc -O1 $includes code.c -o as_it_is
# shellcheck disable=SC2086
gcc -O1 -DPETSC_HAVE_BROKEN_RECURSIVE_MACRO=1 $includes code.c -o switched
{
  ./as_it_is
  echo "with the switch:"
  ./switched
} | tee seen
cat > described <<'TEXT'
returned by MPI_Bcast: MPI_ERR_TRUNCATE
seen by its caller: MPI_ERR_BUFFER
with the switch:
returned by MPI_Bcast: MPI_ERR_TRUNCATE
seen by its caller: MPI_ERR_TRUNCATE
TEXT
cmp -s seen described || { echo "described:"; cat described; exit 1; }
