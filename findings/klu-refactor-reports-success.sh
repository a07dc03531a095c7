#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# KLU 1.3 (SuiteSparse 5.12.0): klu_refactor reports success where old pivots make the solution wrong.
#
# klu_refactor keeps the pivots of an earlier matrix. When the values have changed so much that one of them is tiny,
# it returns 1, the status is KLU_OK and the solution is off by 100 %; klu_factor on the same matrix is exact. What
# helps: klu_rgrowth after klu_refactor, and klu_factor where its result is small (1 is perfect; here it is 1e-17).
#
# Needs gcc. Exits 0 while this is so, 1 when it has changed.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

apt-get download -qq -o APT::Sandbox::User=root libsuitesparse-dev=1:5.12.0+dfsg-2 libklu1=1:5.12.0+dfsg-2 libamd2=1:5.12.0+dfsg-2 \
  libcolamd2=1:5.12.0+dfsg-2 libbtf1=1:5.12.0+dfsg-2 libsuitesparseconfig5=1:5.12.0+dfsg-2
for package in *.deb; do dpkg -x "$package" .; done
libraries=$folder/usr/lib/x86_64-linux-gnu

cat > refactor.c <<'C'
#include <klu.h>
#include <stdio.h>
int main(void) {
  /* [1 1; 1 2] and then [1e-17 1; 1 1], by columns; the second with (1, 2) has the solution (1, 1). */
  int columns[] = {0, 2, 4}, rows[] = {0, 1, 0, 1};
  double first[] = {1, 1, 1, 2}, second[] = {1e-17, 1, 1, 1}, x[] = {1, 2}, y[] = {1, 2};
  klu_common common;
  klu_defaults(&common);
  klu_symbolic* symbolic = klu_analyze(2, columns, rows, &common);
  klu_numeric* numeric = klu_factor(columns, rows, first, symbolic, &common);
  int returned = klu_refactor(columns, rows, second, symbolic, numeric, &common);
  printf("klu_refactor: returned %d, status %d, ", returned, common.status);
  klu_solve(symbolic, numeric, 2, 1, x, &common);
  klu_rgrowth(columns, rows, second, symbolic, numeric, &common);
  printf("solution (%g, %g), growth %g\n", x[0], x[1], common.rgrowth);
  klu_free_numeric(&numeric, &common);
  numeric = klu_factor(columns, rows, second, symbolic, &common);
  klu_solve(symbolic, numeric, 2, 1, y, &common);
  printf("klu_factor: solution (%g, %g)\n", y[0], y[1]);
  return 0;
}
C
gcc -Iusr/include/suitesparse refactor.c -o refactor -L"$libraries" -lklu -Wl,-rpath-link,"$libraries"
cat > described <<'TEXT'
klu_refactor: returned 1, status 0, solution (0, 1), growth 1e-17
klu_factor: solution (1, 1)
TEXT
LD_LIBRARY_PATH=$libraries ./refactor | tee seen
cmp -s seen described || { echo "described:"; cat described; exit 1; }
