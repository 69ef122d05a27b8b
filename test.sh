#!/usr/bin/env bash
# Builds with warnings as errors and runs the tests; the unit tests a second time under the address and
# undefined-behaviour sanitizers. Installs what is missing. tests/README.md says which label holds what.
#   ./test.sh             all but the long ones
#   ./test.sh --browser   and the report in a browser
#   ./test.sh --all       and the long validation, the benchmarks, the browser, clang-tidy on every file, and the unit
#                         tests by Clang and for other processors, and what goes over MPI: ranks, a fluid of LAMMPS
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

without=(long benchmark browser)
all=
groups=(run study import python test)
case ${1-} in
  "") ;;
  --browser) without=(long benchmark) groups+=(browser) ;;
  --all) without=(none) groups+=(browser cluster) all=1 ;;
  *)
    echo "test.sh: unknown option '$1'; --browser, --all or none" >&2
    exit 2
    ;;
esac

results=$(mktemp)
building=
trap 'rm -f "$results"; [ -z "$building" ] || kill -- "-$building" 2>/dev/null' EXIT
failed=0
# Many tests wait for processes, so there is room for one more than there are cores.
run_tests() { # FOLDER CTEST-OPTIONS...
  ctest --test-dir "$1" --output-on-failure --no-tests=error --parallel $(($(nproc) + 1)) "${@:2}" | tee -a "$results" || failed=1
}

# In a folder of its own, for the plain build has no MPI in it.
test_over_mpi() {
  local options=() targets=(coupler solid_solver fluid_solver) names=()
  if tools/install.sh ranks; then
    options+=(-DTORYU_MPI=ON) targets+=(ranks_test fake_solid) names+=(FluidOverRanks ranks conformance.fluid_over)
  else
    options+=(-DTORYU_MPI=OFF)
    echo "test.sh: the tests of ranks are left out: their packages cannot be installed" >&2
  fi
  if tools/install.sh lammps; then
    options+=(-DTORYU_LAMMPS=ON) targets+=(lammps_fluid fake_solid) names+=(lammps_fluid conformance.lammps)
  else
    options+=(-DTORYU_LAMMPS=OFF)
    echo "test.sh: the tests of lammps_fluid are left out: their packages cannot be installed" >&2
  fi
  [ ${#names[@]} -gt 0 ] || return 0
  tools/build.sh ranks -DTORYU_TESTS=ON -DTORYU_WARNINGS_AS_ERRORS=ON "${options[@]}" "${targets[@]}"
  run_tests build/ranks --tests-regex "^($(IFS='|' && echo "${names[*]}"))[._]"
}

tools/install.sh "${groups[@]}"
tools/build.sh release -DTORYU_TESTS=ON -DTORYU_PYTHON=ON -DTORYU_WARNINGS_AS_ERRORS=ON
# Tests wait for processes half of the time: the build for the sanitizers takes what they leave, in a group that ends with this script.
setsid nice -n 19 tools/build.sh debug -DTORYU_TESTS=ON -DTORYU_WARNINGS_AS_ERRORS=ON unit_tests 2> >(cat >&2) &
building=$!
run_tests build/release --label-exclude "^($(IFS='|' && echo "${without[*]}"))\$"
wait "$building"
building=
run_tests build/debug --label-regex '^unit$'
if [ -n "$all" ]; then
  tools/check_code.sh --all || failed=1
  tools/test_targets.sh || failed=1
  test_over_mpi
fi

awk -v seconds=$SECONDS '/tests passed, [0-9]+ tests? failed out of/ {
    for (i = 1; i < NF; ++i) if ($i == "failed") bad += $(i - 2)
    all += $NF
  } END {
    printf "%d of %d tests passed, %d failed, in %d s, build included\n", all - bad, all, bad, seconds
  }' "$results"
exit $failed
