#!/usr/bin/env bash
# Builds the unit tests for other compilers and processors than this one, with warnings as errors, and runs them: by
# Clang for x86-64-v3 (4 lanes) and by GCC for x86-64-v2 (2 lanes). `./test.sh` builds for the processor that it runs on.
#   tools/test_targets.sh             all
#   tools/test_targets.sh PRESET...   some: clang-v3, gcc-v2
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
tools/install.sh run import test ci
[ $# -gt 0 ] || set -- clang-v3 gcc-v2
failed=0
for preset in "$@"; do
  case $preset in
    clang-v3) needs=avx2 ;;
    gcc-v2) needs=sse4_2 ;;
    *)
      echo "test_targets.sh: unknown preset '$preset'; clang-v3 or gcc-v2" >&2
      exit 2
      ;;
  esac
  tools/build.sh "$preset" -DTORYU_TESTS=ON -DTORYU_WARNINGS_AS_ERRORS=ON unit_tests
  if ! grep -qw "$needs" /proc/cpuinfo; then
    echo "test_targets.sh: this processor has no $needs; $preset is built, but not run" >&2
    continue
  fi
  ctest --test-dir "build/$preset" --output-on-failure --no-tests=error --parallel "$(nproc)" --label-regex '^unit$' \
    >"build/$preset/test.log" 2>&1 || {
    cat "build/$preset/test.log" >&2
    failed=1
  }
  echo "$preset: $(grep 'tests passed' "build/$preset/test.log")"
done
exit $failed
