#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# PETSc 3.18.5: options of inner solvers are looked at when they are first needed, not when options are read.
#
# A type that does not exist is refused by KSPSetFromOptions at the top level. Below a prefix (-sub_, -fieldsplit_0_)
# it is accepted there and fails in KSPSetUp, when matrices have been filled. And who tries again after that
# failure is no wiser: block Jacobi then solves with its own choice and reports convergence.
# What helps: a KSPSetUp with a small matrix before any work, and no second call after a code that is not 0.
#
# Exits 0 while this is so, 1 when it has changed.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

# The C and C++ run-time stay those of the system.
mkdir -p archives/partial
: > none-installed
apt-get install python3-petsc4py-real3.18=3.18.5-1 -qq -y --download-only --no-install-recommends -o Dir::State::status="$folder/none-installed" \
  -o Dir::Cache::archives="$folder/archives" -o Debug::NoLocking=1 -o APT::Sandbox::User=root > log 2>&1 || { cat log; exit 1; }
for package in archives/*.deb; do
  case "$package" in
    archives/libc6_* | archives/libc-bin_* | archives/libgcc-s1_* | archives/libstdc++6_*) ;;
    *) dpkg -x "$package" . ;;
  esac
done
export PYTHONPATH=$folder/usr/lib/python3/dist-packages:$folder/usr/lib/petscdir/petsc3.18/x86_64-linux-gnu-real/lib/python3/dist-packages
libraries=$folder/usr/lib/x86_64-linux-gnu
export LD_LIBRARY_PATH=$libraries:$libraries/blas:$libraries/lapack:$libraries/openmpi/lib
# Open MPI looks for its parts where it was built, and for a helper that one process does without.
export OPAL_PREFIX=$folder/usr OPAL_LIBDIR=$libraries/openmpi/lib OPAL_PKGDATADIR=$folder/usr/share/openmpi
export OPAL_PKGLIBDIR=$libraries/openmpi/lib/openmpi3 PMIX_INSTALL_PREFIX=$libraries/pmix2
export OMPI_MCA_ess_singleton_isolated=1 OMPI_MCA_mca_base_component_path=$libraries/openmpi/lib/openmpi3

cat > options.py <<'PYTHON'
import sys
import petsc4py

petsc4py.init(sys.argv[:1])
from petsc4py import PETSc

matrix = PETSc.Mat().createAIJ((4, 4), comm=PETSc.COMM_SELF)
matrix.setUp()
for k in range(4):
    matrix[k, k] = 2.0
matrix.assemble()
right, solution = matrix.createVecs()
right.set(1.0)


def code(call):
    try:
        call()
        return "accepted"
    except PETSc.Error as error:
        return f"code {error.ierr}"


options = PETSc.Options()
for number, given in enumerate(({"pc_type": "ILU"}, {"pc_type": "bjacobi", "sub_pc_type": "ILU"})):
    solver = PETSc.KSP().create(comm=PETSc.COMM_SELF)
    solver.setOptionsPrefix(f"case{number}_")
    for name, value in given.items():
        options[f"case{number}_{name}"] = value
    solver.setOperators(matrix)
    print(" ".join(f"-{name} {value}" for name, value in given.items()))
    print("  KSPSetFromOptions:", code(solver.setFromOptions))
    if number == 0:
        continue
    print("  KSPSetUp:", code(solver.setUp))
    print("  KSPSolve after it:", code(lambda: solver.solve(right, solution)), end=", ")
    print("converged" if solver.getConvergedReason() > 0 else "not converged")
PYTHON
python3 options.py 2>log | tee seen
cat > described <<'TEXT'
-pc_type ILU
  KSPSetFromOptions: code 86
-pc_type bjacobi -sub_pc_type ILU
  KSPSetFromOptions: accepted
  KSPSetUp: code 86
  KSPSolve after it: accepted, converged
TEXT
cmp -s seen described || { cat log; echo "described:"; cat described; exit 1; }
