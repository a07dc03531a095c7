#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# OpenTURNS 1.20: Sobol' indices are computed with a wrong size of the design, and are wrong.
#
# The design of 64 points for two inputs has 64 (2 + 2) = 256 rows, and its size has to be given again when the
# indices are computed. SaltelliSensitivityAlgorithm takes 32 or 40 as well: no exception, but first-order indices
# of 0.1 where 0.96 is right, and total ones of an input of little effect near 1. What helps: compare the rows with
# N (d + 2) (or N (2 d + 2) with second order) before.
#
# Exits 0 while this is so, 1 when it has changed.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

# The C and C++ run-time stay those of the system.
mkdir -p archives/partial
: > none-installed
apt-get install python3-openturns=1.20-9 -qq -y --download-only --no-install-recommends -o Dir::State::status="$folder/none-installed" \
  -o Dir::Cache::archives="$folder/archives" -o Debug::NoLocking=1 -o APT::Sandbox::User=root > log 2>&1 || { cat log; exit 1; }
for package in archives/*.deb; do
  case "$package" in
    archives/libc6_* | archives/libc-bin_* | archives/libgcc-s1_* | archives/libstdc++6_*) ;;
    *) dpkg -x "$package" . ;;
  esac
done
export PYTHONPATH=$folder/usr/lib/python3/dist-packages OPENTURNS_CONFIG_PATH=$folder/etc/openturns
libraries=$folder/usr/lib/x86_64-linux-gnu
export LD_LIBRARY_PATH=$libraries:$libraries/blas:$libraries/lapack:$libraries/atlas:$folder/usr/lib:$folder/lib/x86_64-linux-gnu

cat > indices.py <<'PYTHON'
import openturns as ot

inputs = ot.ComposedDistribution([ot.Uniform(-1, 1)] * 2)
size = 64
design = ot.SobolIndicesExperiment(inputs, size).generate()
outputs = ot.SymbolicFunction(["a", "b"], ["a + 0.2 * b"])(design)
exact = 1 / 1.04  # of a: variances 1/3 and 0.04/3
print(design.getSize(), "rows")
for given in (64, 40, 32):
    try:
        found = ot.SaltelliSensitivityAlgorithm(design, outputs, given)
        first, total = found.getFirstOrderIndices(), found.getTotalOrderIndices()
        right = abs(first[0] - exact) < 0.2 and abs(total[1] - (1 - exact)) < 0.2
        print(f"size {given}: {'right' if right else 'wrong'} indices")
    except Exception as error:
        print(f"size {given}: {type(error).__name__}")
PYTHON
python3 indices.py | tee seen
cat > described <<'TEXT'
256 rows
size 64: right indices
size 40: wrong indices
size 32: wrong indices
TEXT
cmp -s seen described || { echo "described:"; cat described; exit 1; }
