#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# MUMPS 5.5.1 (Debian 12): no return code tells that an ordering was not built in and another one is used.
#
# ICNTL(7) = 5 asks for METIS. Debian's MUMPS has none and orders by AMF (2) instead, and INFOG(1) is 0 as if
# nothing were the matter, though positive values are there for warnings. The one trace is a line among the
# statistics, which programs turn off (PETSc does, so that -mat_mumps_icntl_7 5 changes nothing unseen). Factors of
# large meshes come out several times larger. What helps: compare INFOG(7), what was used, with what was asked.
#
# Needs gcc. Exits 0 while this is so, 1 when it has changed.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

apt-get download -qq -o APT::Sandbox::User=root libmumps-seq-dev=5.5.1-1 libmumps-seq-5.5=5.5.1-1 libmumps-dev=5.5.1-1 \
  libmumps-headers-dev=5.5.1-1 libscotch-7.0=7.0.3-2 libblas3=3.11.0-2 liblapack3=3.11.0-2 \
  libgfortran5=12.2.0-14+deb12u1 \
  libquadmath0=12.2.0-14+deb12u1
for package in *.deb; do dpkg -x "$package" .; done
libraries=$folder/usr/lib/x86_64-linux-gnu
path=$libraries:$libraries/blas:$libraries/lapack:$libraries/scotch-int32

cat > ordering.c <<'C'
#include <dmumps_c.h>
#include <stdio.h>
enum { side = 20, size = side * side };
static int rows[5 * size], columns[5 * size];
static double values[5 * size];
static DMUMPS_STRUC_C solver;
static void put(int row, int column, double value) {
  rows[solver.nnz] = row + 1;
  columns[solver.nnz] = column + 1;
  values[solver.nnz++] = value;
}
int main(void) {
  solver.job = -1;
  solver.par = 1;
  solver.comm_fortran = -987654;
  dmumps_c(&solver);
  solver.n = size; /* the Laplacian of a square, by five points */
  for (int k = 0; k < size; ++k) {
    put(k, k, 4);
    if (k % side > 0) put(k, k - 1, -1);
    if (k % side < side - 1) put(k, k + 1, -1);
    if (k >= side) put(k, k - side, -1);
    if (k < size - side) put(k, k + side, -1);
  }
  solver.irn = rows;
  solver.jcn = columns;
  solver.a = values;
  solver.icntl[1] = solver.icntl[2] = 0; /* no statistics, as within PETSc */
  solver.job = 1; /* analysis */
  const int asked[] = {4, 5};
  const char* const names[] = {"PORD", "METIS"};
  for (int k = 0; k < 2; ++k) {
    solver.icntl[6] = asked[k];
    dmumps_c(&solver);
    printf("asked for %s (%d): used %d, INFOG(1) = %d, INFOG(2) = %d\n", names[k], asked[k], solver.infog[6],
           solver.infog[0], solver.infog[1]);
  }
  solver.job = -2;
  dmumps_c(&solver);
  return 0;
}
C
gcc -Iusr/include -Iusr/include/mumps_seq ordering.c -o ordering -L"$libraries" -ldmumps_seq -Wl,--allow-shlib-undefined
cat > described <<'TEXT'
asked for PORD (4): used 4, INFOG(1) = 0, INFOG(2) = 0
asked for METIS (5): used 2, INFOG(1) = 0, INFOG(2) = 0
TEXT
LD_LIBRARY_PATH=$path ./ordering 2>&1 | tee seen
cmp -s seen described || { echo "described:"; cat described; exit 1; }
