#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# UDUNITS-2 2.2.28: a number that follows a unit multiplies it.
#
# "mmHg -10" is no unit with a slip behind it but minus ten millimetres of mercury. "dyne/cm3.5", which looks like
# a power of 3.5, is half a dyne per cubic centimetre (the number is .5), and yet "cm3/s.5" is five times cm3/s (the
# dot is a product). Nothing is reported, so that a program that reads "NUMBER UNIT" and hands the rest to UDUNITS
# gets another value instead of an error.
# What helps: refuse a unit that has a number anywhere but as the exponent of a name.
#
# Exits 0 while this is so, 1 when it has changed.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

apt-get download -qq -o APT::Sandbox::User=root udunits-bin=2.2.28-5 libudunits2-0=2.2.28-5 libudunits2-data=2.2.28-5
for package in *.deb; do dpkg -x "$package" .; done
export LD_LIBRARY_PATH=$folder/usr/lib/x86_64-linux-gnu
export UDUNITS2_XML_PATH=$folder/usr/share/xml/udunits/udunits2.xml

factor() { # HAVE WANT: the line "1 HAVE = X WANT"
  usr/bin/udunits2 -H "$1" -W "$2" | sed -n 's/^ *1 .* = \(.*\) .*$/\1/p'
}
changed=0
while IFS='|' read -r have want described; do
  seen=$(factor "$have" "$want") || true
  echo "1 \"$have\" = $seen $want (described: $described)"
  [ "$seen" = "$described" ] || changed=1
done <<'CASES'
mmHg|Pa|133.322
mmHg -10|Pa|-1333.22
dyne/cm3|N/m3|10
dyne/cm3.5|N/m3|5
cm3/s.5|m3/s|5e-06
CASES
exit $changed
