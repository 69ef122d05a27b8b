#!/usr/bin/env bash
# Installs the Debian packages that are missing: tools/install.sh GROUP... (groups of packages.txt). Says and does
# nothing if all are there. Works as root or by sudo and asks no questions; ends with 5 if they cannot be installed.
set -euo pipefail
list=$(dirname "${BASH_SOURCE[0]}")/packages.txt

wanted=()
for group in "$@"; do
  mapfile -t of_group < <(awk -v group="[$group]" '/^\[/ { on = $0 == group; next } on && /^[a-z]/' "$list")
  [ ${#of_group[@]} -gt 0 ] || { echo "install: no group '$group' in $list" >&2; exit 1; }
  wanted+=("${of_group[@]}")
done

if ! command -v dpkg-query >/dev/null; then
  echo "install: this is no Debian; install by yourself what stands for: ${wanted[*]}" >&2
  exit 0
fi
find_missing() {
  local installed package
  installed=$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "${wanted[@]}" 2>/dev/null || true)
  missing=()
  for package in "${wanted[@]}"; do
    grep -qxF "installed $package" <<<"$installed" || missing+=("$package")
  done
}
find_missing
[ ${#missing[@]} -gt 0 ] || exit 0
exec 9<"$list" # one at a time
flock 9 2>/dev/null || true
find_missing
[ ${#missing[@]} -gt 0 ] || exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || {
    echo "install: error: the machine: needs root or sudo; run as root: apt-get install ${missing[*]}" >&2
    exit 5
  }
  as_root=(sudo)
fi
echo "Installing ${#missing[@]} Debian packages: ${missing[*]}" >&2 || true
log=$(mktemp)
trap 'rm -f "$log"' EXIT
if ! { "${as_root[@]}" apt-get -qq update &&
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get -qq -y -o DPkg::Lock::Timeout=600 --no-install-recommends install "${missing[@]}"; } >"$log" 2>&1 </dev/null; then
  cat "$log" >&2
  echo "install: error: the machine: apt-get failed, see above" >&2
  exit 5
fi
