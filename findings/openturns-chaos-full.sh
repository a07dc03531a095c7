#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# OpenTURNS 1.20: polynomial chaos fits 68 terms to 20 points, and reports an error of nothing.
#
# The function is Ishigami's. FunctionalChaosAlgorithm(inputs, outputs, distribution) chooses full least squares
# with more unknowns than equations: no exception, no warning, a relative error of 1e-31, and at other points the
# prediction is worse than the mean. What helps: more points than terms (getCoefficients().getSize()), or sparse
# selection (LeastSquaresMetaModelSelectionFactory), and validation at points that the model has not seen.
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

cat > chaos.py <<'PYTHON'
import math
import openturns as ot

inputs = ot.ComposedDistribution([ot.Uniform(-math.pi, math.pi)] * 3)
function = ot.SymbolicFunction(["a", "b", "c"], ["sin(a) + 7 * sin(b)^2 + 0.1 * c^4 * sin(a)"])
ot.RandomGenerator.SetSeed(1)
points, others = inputs.getSample(20), inputs.getSample(1000)
chaos = ot.FunctionalChaosAlgorithm(points, function(points), inputs)
chaos.run()
result = chaos.getResult()
terms, error = result.getCoefficients().getSize(), result.getRelativeErrors()[0]
factor = ot.MetaModelValidation(others, function(others), result.getMetaModel()).computePredictivityFactor()[0]
print(f"20 points, {terms} terms, relative error {'below' if error < 1e-20 else 'above'} 1e-20")
print(f"predictivity at 1000 other points {'negative' if factor < 0 else 'positive'}")
PYTHON
python3 chaos.py | tee seen
cat > described <<'TEXT'
20 points, 68 terms, relative error below 1e-20
predictivity at 1000 other points negative
TEXT
cmp -s seen described || { echo "described:"; cat described; exit 1; }
