#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# OpenBLAS 0.3.21: a processor whose model number it does not know gets the kernels of 2004.
#
# The library chooses its kernels by family and model. Two processors with the same features, AVX2 among them, are
# emulated here: model 151 of Intel's family 6 (2021) gets the Haswell kernels, model 183 (2022) and model 207
# (2023) those of Prescott, which know SSE3 alone and are several times slower. Nothing is reported.
# What helps: OPENBLAS_CORETYPE=Haswell (or SkylakeX) in the environment before the library is loaded;
# openblas_get_corename() tells what was chosen.
#
# Needs gcc. Exits 0 while this is so, 1 when it has changed.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

apt-get download -qq -o APT::Sandbox::User=root libopenblas0-pthread=0.3.21+ds-4 qemu-user-static=1:7.2+dfsg-7+deb12u18+b3 \
  libgfortran5=12.2.0-14+deb12u1 libquadmath0=12.2.0-14+deb12u1
for package in *.deb; do dpkg -x "$package" .; done
unset OPENBLAS_CORETYPE
export LD_LIBRARY_PATH=$folder/usr/lib/x86_64-linux-gnu

cat > corename.c <<'C'
#include <stdio.h>
char* openblas_get_corename(void);
int main(void) {
  __builtin_cpu_init();
  printf("%s %s", openblas_get_corename(), __builtin_cpu_supports("avx2") ? "avx2" : "no-avx2");
  return 0;
}
C
library=$folder/usr/lib/x86_64-linux-gnu/openblas-pthread
gcc corename.c -o corename "$library/libopenblas.so.0" -Wl,-rpath,"$library"

changed=0
while read -r model described; do
  seen=$(usr/bin/qemu-x86_64-static -cpu "max,vendor=GenuineIntel,family=6,model=$model" ./corename)
  echo "family 6, model $model: $seen (described: $described)"
  [ "$seen" = "$described" ] || changed=1
done <<'CASES'
60 Haswell avx2
151 Haswell avx2
183 Prescott avx2
207 Prescott avx2
CASES
exit $changed
