#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# CVODES 6.4.1: from a state at rest it steps over a pulse of the inflow, and reports success.
#
# A compliance with a resistance, C dp/dt = q - p/R with RC = 1 ms, gets q = 1 from 0.5 to 0.503 s and nothing
# before. At rest the error is 0, so that the step grows tenfold and more each time: six steps make up the whole
# second, none of them in the pulse. Every call of CVode, one a millisecond, returns CV_SUCCESS at a relative
# tolerance of 1e-8, and p stays 0 where it should reach 0.95. What helps: CVodeSetStopTime (and CVodeReInit) at
# every jump of the data; a largest step alone (CVodeSetMaxStep) costs steps all the way.
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

cat > pulse.c <<'C'
#include <cvodes/cvodes.h>
#include <math.h>
#include <nvector/nvector_serial.h>
#include <stdio.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
static const double begin = 0.5, end = 0.503, decay = 1e-3;
static int rate(double t, N_Vector p, N_Vector rate_of_p, void* data) {
  (void)data;
  const double q = t >= begin && t < end ? 1 : 0;
  NV_Ith_S(rate_of_p, 0) = (q - NV_Ith_S(p, 0)) / decay;
  return 0;
}
/* The greatest p that CVODES computes, in stretches that end at the given times. */
static double greatest(const double* ends, int count, long* steps) {
  SUNContext context;
  SUNContext_Create(NULL, &context);
  N_Vector p = N_VNew_Serial(1, context);
  NV_Ith_S(p, 0) = 0;
  void* memory = CVodeCreate(CV_BDF, context);
  CVodeInit(memory, rate, 0, p);
  CVodeSStolerances(memory, 1e-8, 1e-10);
  SUNMatrix matrix = SUNDenseMatrix(1, 1, context);
  CVodeSetLinearSolver(memory, SUNLinSol_Dense(p, matrix, context), matrix);
  double t = 0, most = 0;
  *steps = 0;
  for (int stretch = 0; stretch < count; ++stretch) {
    CVodeReInit(memory, t, p);
    CVodeSetStopTime(memory, ends[stretch]);
    while (t < ends[stretch]) {
      if (CVode(memory, fmin(t + 1e-3, ends[stretch]), p, &t, CV_NORMAL) < 0) return NAN;
      most = fmax(most, NV_Ith_S(p, 0));
    }
    long more = 0;
    CVodeGetNumSteps(memory, &more);
    *steps += more;
  }
  return most;
}
int main(void) {
  const double ends[] = {begin, end, 1};
  long steps = 0;
  double most = greatest(ends + 2, 1, &steps);
  printf("as it is: greatest p %.4f, %s\n", most, steps < 20 ? "fewer than 20 steps" : "20 steps and more");
  most = greatest(ends, 3, &steps);
  printf("stopping at the jumps: greatest p %.4f\n", most);
  printf("exact: %.4f\n", 1 - exp(-(end - begin) / decay));
  return 0;
}
C
gcc -Iusr/include pulse.c -o pulse -L"$libraries" -lsundials_cvodes -lsundials_nvecserial \
  -lsundials_sunmatrixdense -lsundials_sunlinsoldense -lm -Wl,--allow-shlib-undefined
cat > described <<'TEXT'
as it is: greatest p 0.0000, fewer than 20 steps
stopping at the jumps: greatest p 0.9502
exact: 0.9502
TEXT
LD_LIBRARY_PATH=$libraries ./pulse | tee seen
cmp -s seen described || { echo "described:"; cat described; exit 1; }
