#!/usr/bin/env bash
# Builds quietly what is out of date: tools/build.sh PRESET [-DOPTION=VALUE ...] [-DOPTION?=VALUE ...] [TARGET ...].
# OPTION?=VALUE is for a folder that is configured for the first time. On a terminal one line shows how far it is; the
# compiler's output is shown if it fails, and stays in build/PRESET/build.log. Ends with 1 if a file cannot be compiled,
# with 5 if the machine does not let it build.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
preset=$1
shift
options=() first_options=() targets=()
for argument in "$@"; do
  case $argument in
    -D*\?=*) first_options+=("${argument/\?=/=}") ;;
    -D*) options+=("$argument") ;;
    *) targets+=("$argument") ;;
  esac
done
folder=build/$preset
log=$folder/build.log

say() { echo "$1" >&2 || true; } # nobody need read it
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
  cat "$log" >&2 || true
  say "build: $1 failed, see above ($log)"
  ! grep -qE 'No space left|Disk quota exceeded|Cannot allocate memory|Killed signal' "$log" || exit 5
  exit 1
}

# Whether it is, and here: a copy of the sources with its build folder must be configured anew.
is_configured() {
  local home
  home=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$folder/CMakeCache.txt" 2>/dev/null) || true
  [ -f "$folder/build.ninja" ] && [ "$home" -ef "$PWD" ]
}
# Without options, what was configured before stays: run.sh and test.sh share a folder, and neither undoes the other.
is_built() {
  is_configured && [ ${#options[@]} -eq 0 ] && [ ${#targets[@]} -gt 0 ] &&
    [[ $(ninja -C "$folder" -n "${targets[@]}" 2>&1) == *"ninja: no work to do."* ]]
}
has_programs() {
  local target
  [ ${#targets[@]} -gt 0 ] || return 1
  for target in "${targets[@]}"; do [ -x "$folder/bin/$target" ] || return 1; done
}
# The programs read the commit of the sources from a file: it changes more often than they do.
write_commit() {
  cmake -DSOURCE="$PWD" -DFOLDER="$PWD/$folder/bin" -P common/run/write_commit.cmake >/dev/null 2>&1 || true
}
build() {
  local anew=()
  is_configured || anew=(--fresh "${first_options[@]}")
  [ ${#anew[@]} -eq 0 ] && [ ${#options[@]} -eq 0 ] ||
    cmake --preset "$preset" "${anew[@]}" "${options[@]}" >"$log" 2>&1 || fail "configuring $folder"
  local command=(cmake --build "$folder" --parallel "$(nproc)") start=$SECONDS
  [ ${#targets[@]} -eq 0 ] || command+=(--target "${targets[@]}")
  "${command[@]}" 2>&1 | tee "$log" | show_progress || fail "building $folder"
  ! grep -qE '^\[.*\] (Building|Linking)' "$log" || say "Built $folder in $((SECONDS - start)) s"
}

if ! mkdir -p "$folder" 2>/dev/null || [ ! -w "$folder" ]; then
  is_built && exit 0
  has_programs || {
    say "build: error: the machine: $PWD/$folder cannot be written; build as a user who may, or in a copy of the sources"
    exit 5
  }
  say "warning: the sources are newer than the programs in $folder, which cannot be written: these run as they are"
  exit 0
fi
if ! is_built; then
  # One at a time. Where the file system has no locks, the second takes its chance.
  exec 9>"$folder/build.lock"
  flock --nonblock --conflict-exit-code 75 9 2>/dev/null || [ $? -ne 75 ] || {
    say "waiting for another build of $folder"
    flock 9
  }
  is_built || build 9>&-
  exec 9>&-
fi
write_commit
