#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# meshio 5.0.0 (Debian's package 7.0.0-3): an XDMF attribute with an Information is not read, and the failure ends Python.
#
# XDMF allows <Information> in every element; in an <Attribute> it is the place for the unit of a field. meshio's
# reader takes whatever stands first in an attribute for its data. And meshio.read() calls sys.exit(1): "except
# Exception" does not catch that, so that one file ends a script that goes through many.
# What helps: Information beside the attribute (in the Grid), and "except SystemExit" around meshio.read().
#
# Exits 0 while this is so, 1 when it has changed.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

# The C and C++ run-time stay those of the system.
mkdir -p archives/partial
: > none-installed
apt-get install python3-meshio=7.0.0-3 python3-h5py=3.7.0-8 -qq -y --download-only --no-install-recommends -o Dir::State::status="$folder/none-installed" \
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

cat > read.py <<'PYTHON'
import contextlib
import io
import meshio

TRIANGLE = """<?xml version="1.0"?>
<Xdmf Version="3.0"><Domain><Grid Name="triangle" GridType="Uniform">{beside}
<Topology TopologyType="Triangle" NumberOfElements="1"><DataItem DataType="Int" Precision="8" Dimensions="1 3"
 Format="XML">0 1 2</DataItem></Topology>
<Geometry GeometryType="XYZ"><DataItem DataType="Float" Precision="8" Dimensions="3 3"
 Format="XML">0 0 0 1 0 0 0 1 0</DataItem></Geometry>
<Attribute Name="pressure" AttributeType="Scalar" Center="Node">{inside}<DataItem DataType="Float" Precision="8"
 Dimensions="3" Format="XML">1 2 3</DataItem></Attribute>
</Grid></Domain></Xdmf>
"""
UNIT = '<Information Name="unit" Value="dyn/cm2"/>'


def read(name, **places):
    with open(name, "w", encoding="utf-8") as file:
        file.write(TRIANGLE.format(**{"beside": "", "inside": "", **places}))
    try:
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            return str(meshio.read(name).point_data["pressure"].tolist())
    except Exception as error:
        return type(error).__name__
    except SystemExit:
        return "SystemExit"


print("without:", read("without.xdmf"))
print("inside the attribute:", read("inside.xdmf", inside=UNIT))
PYTHON
cat > described <<'TEXT'
without: [1.0, 2.0, 3.0]
inside the attribute: SystemExit
TEXT
python3 read.py | tee seen
cmp -s seen described || { echo "described:"; cat described; exit 1; }
