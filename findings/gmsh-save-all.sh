#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Gmsh 4.8.4: with Mesh.SaveAll a file of format 2.2 lists physical names that no element bears.
#
# The names stand in $PhysicalNames with their tags, and every element has the physical tag 0, those of the named
# parts included: the parts cannot be told from the file any more, though it looks as if they could. Format 4.1
# keeps them with the same option. What helps: Mesh.SaveAll = 0, or Mesh.MshFileVersion = 4.1.
#
# Exits 0 while this is so, 1 when it has changed.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

# Gmsh links some ninety libraries: all but the C and C++ run-time come along.
mkdir -p archives/partial
: > none-installed
apt-get install gmsh=4.8.4+ds2-3 -qq -y --download-only --no-install-recommends -o Dir::State::status="$folder/none-installed" \
  -o Dir::Cache::archives="$folder/archives" -o Debug::NoLocking=1 -o APT::Sandbox::User=root > log 2>&1 || { cat log; exit 1; }
for package in archives/*.deb; do
  case "$package" in
    archives/libc6_* | archives/libc-bin_* | archives/libgcc-s1_* | archives/libstdc++6_*) ;;
    *) dpkg -x "$package" . ;;
  esac
done
libraries=$folder/usr/lib/x86_64-linux-gnu
export LD_LIBRARY_PATH=$libraries:$libraries/blas:$libraries/lapack:$libraries/openmpi/lib:$folder/lib/x86_64-linux-gnu

cat > triangle.geo <<'GEO'
Point(1) = {0, 0, 0, 1}; Point(2) = {1, 0, 0, 1}; Point(3) = {0, 1, 0, 1};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 1};
Curve Loop(1) = {1, 2, 3}; Plane Surface(1) = {1};
Physical Curve("inlet", 7) = {1};
Physical Surface("blood", 9) = {1};
GEO

# Of format 2.2: names listed, elements, elements with a physical tag other than 0.
summary() {
  awk '/^\$/ { section = $1; line = 0; next }
       section == "$PhysicalNames" && NF == 3 { names++ }
       section == "$Elements" && NF > 3 { elements++; if ($4 != 0) tagged++ }
       END { printf "%d names, %d elements, %d of them tagged", names, elements, tagged }' "$1"
}
changed=0
while IFS='|' read -r save_all described; do
  usr/bin/gmsh -v 1 -2 triangle.geo -setnumber Mesh.SaveAll "$save_all" -setnumber Mesh.MshFileVersion 2.2 -o out.msh
  seen=$(summary out.msh)
  echo "SaveAll = $save_all: $seen (described: $described)"
  [ "$seen" = "$described" ] || changed=1
done <<'CASES'
0|2 names, 3 elements, 3 of them tagged
1|2 names, 9 elements, 0 of them tagged
CASES
exit $changed
