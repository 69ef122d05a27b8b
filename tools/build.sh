#!/usr/bin/env bash
# Builds quietly: tools/build.sh PRESET [-DOPTION=VALUE ...] [TARGET ...]. On a terminal one line shows how far it is;
# the compiler's output is shown if it fails, and stays in build/PRESET/build.log.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
preset=$1
shift
options=() targets=()
for argument in "$@"; do
  case $argument in
    -D*) options+=("$argument") ;;
    *) targets+=("$argument") ;;
  esac
done
folder=build/$preset
log=$folder/build.log
mkdir -p "$folder"

show_progress() {
  if [ -t 2 ]; then
    awk -v what="Building $folder" 'match($0, /^\[[0-9]+\/[0-9]+\]/) {
      printf "\r%s %s", what, substr($0, 1, RLENGTH) > "/dev/stderr"; fflush("/dev/stderr")
    } END { printf "\r\033[K" > "/dev/stderr" }'
  else
    cat >/dev/null
  fi
}
fail() {
  cat "$log" >&2
  echo "build: $1 failed, see above ($log)" >&2
  exit 1
}

# Without options, what was configured before stays: run.sh and test.sh share a folder, and neither undoes the other.
if [ ! -f "$folder/build.ninja" ] || [ ${#options[@]} -gt 0 ]; then
  cmake --preset "$preset" "${options[@]}" >"$log" 2>&1 || fail "configuring $folder"
fi
command=(cmake --build "$folder" --parallel "$(nproc)")
[ ${#targets[@]} -eq 0 ] || command+=(--target "${targets[@]}")
start=$SECONDS
"${command[@]}" 2>&1 | tee "$log" | show_progress || fail "building $folder"
! grep -qE '^\[.*\] (Building|Linking)' "$log" || echo "Built $folder in $((SECONDS - start)) s" >&2
