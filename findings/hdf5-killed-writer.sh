#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# HDF5 1.10.8: flushing each step does not keep a file readable when its writer is killed.
#
# A series of steps is written, each followed by a flush, and the process is killed. With the newest format
# (libver="latest") all data are on disk, but the file cannot be opened until somebody runs "h5clear -s" on it; with
# the oldest format it can. Without flushes neither can. What helps: the oldest format with a flush a step, or a
# file of its own for each step, written aside and renamed.
#
# Exits 0 while this is so, 1 when it has changed.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

# The C and C++ run-time stay those of the system.
mkdir -p archives/partial
: > none-installed
apt-get install python3-h5py=3.7.0-8 hdf5-tools=1.10.8+repack1-1 -qq -y --download-only --no-install-recommends -o Dir::State::status="$folder/none-installed" \
  -o Dir::Cache::archives="$folder/archives" -o Debug::NoLocking=1 -o APT::Sandbox::User=root > log 2>&1 || { cat log; exit 1; }
for package in archives/*.deb; do
  case "$package" in
    archives/libc6_* | archives/libc-bin_* | archives/libgcc-s1_* | archives/libstdc++6_*) ;;
    *) dpkg -x "$package" . ;;
  esac
done
export PYTHONPATH=$folder/usr/lib/python3/dist-packages
libraries=$folder/usr/lib/x86_64-linux-gnu
export LD_LIBRARY_PATH=$libraries:$libraries/blas:$libraries/lapack:$folder/lib/x86_64-linux-gnu

cat > write.py <<'PYTHON'
import os
import signal
import sys
import h5py

file = h5py.File("steps.h5", "w", libver=sys.argv[1])
steps = file.create_dataset("pressure", (0, 1000), maxshape=(None, 1000), chunks=(1, 1000), dtype="d")
for step in range(5):
    steps.resize(step + 1, axis=0)
    steps[step] = step
    if sys.argv[2] == "flushed":
        file.flush()
os.kill(os.getpid(), signal.SIGKILL)
PYTHON
cat > read.py <<'PYTHON'
import h5py

try:
    with h5py.File("steps.h5", "r") as file:
        print(len(file["pressure"]), "steps, the last of", file["pressure"][-1, 0])
except OSError as error:
    print("not opened:", "marked as open for write" if "already open for write" in str(error) else "truncated")
PYTHON
{
  for format in earliest latest; do
    for flushes in flushed unflushed; do
      rm -f steps.h5
      python3 write.py $format $flushes 2>/dev/null || true
      echo "$format, $flushes: $(python3 read.py)"
      if [ "$format $flushes" = "latest flushed" ]; then
        usr/bin/h5clear -s steps.h5
        echo "after h5clear -s: $(python3 read.py)"
      fi
    done
  done
} 2>/dev/null | tee seen
cat > described <<'TEXT'
earliest, flushed: 5 steps, the last of 4.0
earliest, unflushed: not opened: truncated
latest, flushed: not opened: marked as open for write
after h5clear -s: 5 steps, the last of 4.0
latest, unflushed: not opened: truncated
TEXT
cmp -s seen described || { echo "described:"; cat described; exit 1; }
