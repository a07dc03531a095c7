#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# CVODES 6.4.1: tolerances given for sensitivities do not bound their errors.
#
# y' = 1e-3 sin(k t) and its derivative by k, over 10 s at a relative tolerance of 1e-6 and an absolute one of 1e-8
# for both. CVodeSensSStolerances takes the tolerances of the derivative, but the error test looks at y alone until
# CVodeSetSensErrCon(memory, SUNTRUE) is called: y is right to 1e-5 and the derivative 3 % of its range off, with
# no word. The manual has the default in a table. With the call the error falls by more than a hundred times.
#
# Needs gcc. Exits 0 while this is so, 1 when it has changed.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

apt-get download -qq -o APT::Sandbox::User=root libsundials-dev=6.4.1+dfsg1-3 libsundials-cvodes6=6.4.1+dfsg1-3 \
  libsundials-nvecserial6=6.4.1+dfsg1-3 libsundials-sunmatrix4=6.4.1+dfsg1-3 libsundials-sunlinsol3=6.4.1+dfsg1-3
for package in *.deb; do dpkg -x "$package" .; done
libraries=$folder/usr/lib/x86_64-linux-gnu

cat > sensitivity.c <<'C'
#include <cvodes/cvodes.h>
#include <math.h>
#include <nvector/nvector_serial.h>
#include <stdio.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
static const double size = 1e-3, k = 10;
static int rate(double t, N_Vector y, N_Vector rate_of_y, void* data) {
  (void)y, (void)data;
  NV_Ith_S(rate_of_y, 0) = size * sin(k * t);
  return 0;
}
static int rate_by_k(int count, double t, N_Vector y, N_Vector rate_of_y, int which, N_Vector s, N_Vector rate_of_s,
                     void* data, N_Vector one, N_Vector two) {
  (void)count, (void)y, (void)rate_of_y, (void)which, (void)s, (void)data, (void)one, (void)two;
  NV_Ith_S(rate_of_s, 0) = size * t * cos(k * t);
  return 0;
}
int main(void) {
  for (int controlled = 0; controlled < 2; ++controlled) {
    SUNContext context;
    SUNContext_Create(NULL, &context);
    N_Vector y = N_VNew_Serial(1, context), s = N_VNew_Serial(1, context);
    NV_Ith_S(y, 0) = 1;
    NV_Ith_S(s, 0) = 0;
    void* memory = CVodeCreate(CV_BDF, context);
    CVodeInit(memory, rate, 0, y);
    CVodeSStolerances(memory, 1e-6, 1e-8);
    SUNMatrix matrix = SUNDenseMatrix(1, 1, context);
    CVodeSetLinearSolver(memory, SUNLinSol_Dense(y, matrix, context), matrix);
    double absolute[] = {1e-8};
    CVodeSensInit1(memory, 1, CV_STAGGERED, rate_by_k, &s);
    CVodeSensSStolerances(memory, 1e-6, absolute);
    if (controlled) CVodeSetSensErrCon(memory, SUNTRUE);
    double t = 0, error = 0, range = 0;
    for (int i = 1; i <= 100; ++i) {
      if (CVode(memory, 0.1 * i, y, &t, CV_NORMAL) < 0 || CVodeGetSens(memory, &t, &s) < 0) return 1;
      const double exact = size * (t * sin(k * t) / k + (cos(k * t) - 1) / (k * k));
      error = fmax(error, fabs(NV_Ith_S(s, 0) - exact));
      range = fmax(range, fabs(exact));
    }
    printf("%s: error %s\n", controlled ? "CVodeSetSensErrCon" : "as it is",
           error > 0.01 * range ? "above 1 % of the range" : error < 1e-3 * range ? "below 0.1 %" : "between");
  }
  return 0;
}
C
gcc -Iusr/include sensitivity.c -o sensitivity -L"$libraries" -lsundials_cvodes -lsundials_nvecserial \
  -lsundials_sunmatrixdense -lsundials_sunlinsoldense -lm -Wl,--allow-shlib-undefined
cat > described <<'TEXT'
as it is: error above 1 % of the range
CVodeSetSensErrCon: error below 0.1 %
TEXT
LD_LIBRARY_PATH=$libraries ./sensitivity | tee seen
cmp -s seen described || { echo "described:"; cat described; exit 1; }
