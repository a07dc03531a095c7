#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# OpenTURNS 1.20: kriging of inputs in the millions passes through its points and predicts nothing.
#
# Twelve points of sin(R / 2e6), R from 1e6 to 1.2e7 (a peripheral resistance in CGS). The search for the length of
# correlation starts at 1 whatever the data, where the likelihood is flat, and ends there: the model is right at
# its points to 1e-15 and a constant between them (predictivity factor 0). The same data with R in units of 1e6
# give 1. Only the bound above follows the data. What helps: inputs scaled to a size of one, and validation at
# points that the model has not seen.
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

cat > kriging.py <<'PYTHON'
import openturns as ot

for unit in (1e6, 1.0):
    function = ot.SymbolicFunction(["R"], [f"sin(R / {2 * unit})"])
    points = ot.Sample([[k * unit] for k in range(1, 13)])
    between = ot.Sample([[(k + 0.5) * unit] for k in range(1, 12)])
    kriging = ot.KrigingAlgorithm(
        points, function(points), ot.SquaredExponential(1), ot.ConstantBasisFactory(1).build()
    )
    kriging.run()
    model = kriging.getResult().getMetaModel()
    training = max(abs(model(x)[0] - function(x)[0]) for x in points)
    factor = ot.MetaModelValidation(between, function(between), model).computePredictivityFactor()[0]
    print(
        f"inputs of {unit:g} to {12 * unit:g}: error at the points {'below' if training < 1e-4 else 'above'} 1e-4,"
        f" predictivity {'above 0.99' if factor > 0.99 else 'below 0.05' if factor < 0.05 else factor}"
    )
PYTHON
python3 kriging.py | grep -v WRN | tee seen
cat > described <<'TEXT'
inputs of 1e+06 to 1.2e+07: error at the points below 1e-4, predictivity below 0.05
inputs of 1 to 12: error at the points below 1e-4, predictivity above 0.99
TEXT
cmp -s seen described || { echo "described:"; cat described; exit 1; }
