# SPDX-License-Identifier: GPL-3.0-or-later
# shellcheck shell=bash
# What the tools share. Sourcing it ends the script at the first error and changes to the repository's root.

set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

# Both cmake --build and ctest read these; what the caller has set stands.
export CMAKE_BUILD_PARALLEL_LEVEL=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}
export CTEST_PARALLEL_LEVEL=${CTEST_PARALLEL_LEVEL:-$(nproc)}

# say TEXT: a headline, with the seconds since the script began.
say() {
  printf '\n==> [%d s] %s\n' "$SECONDS" "$*"
}

# usage: prints the script's own leading comment, the text of --help.
usage() {
  sed -n '3,/^$/{s/^# \{0,1\}//;p}' "tools/$(basename "$0")"
}

# refuse TEXT: for arguments that make no sense.
refuse() {
  printf '%s: %s (see --help)\n' "$(basename "$0")" "$*" >&2
  exit 2
}

# need_packages GROUP...: installs what is missing of the groups in tools/lib/packages. Nothing is
# asked of the network when all is there.
need_packages() {
  local group packages package missing=()
  if ! command -v dpkg-query >/dev/null; then
    echo "This is no Debian: the packages of tools/lib/packages ($*) have to be there by other means."
    return
  fi
  for group in "$@"; do
    read -ra packages < <(sed -n "s/^$group: //p" tools/lib/packages)
    for package in "${packages[@]}"; do
      if [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" != installed ]; then
        missing+=("$package")
      fi
    done
  done
  if [ ${#missing[@]} -eq 0 ]; then
    return
  fi
  say "Installing ${missing[*]}"
  local as_root=(env DEBIAN_FRONTEND=noninteractive)
  if [ "$(id -u)" -ne 0 ]; then
    as_root=(sudo "${as_root[@]}")
  fi
  "${as_root[@]}" apt-get -qq -o DPkg::Lock::Timeout=300 update
  "${as_root[@]}" apt-get -qq -o DPkg::Lock::Timeout=300 -o Dpkg::Use-Pty=0 \
    install -y --no-install-recommends "${missing[@]}" >/dev/null
}
