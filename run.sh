#!/usr/bin/env bash
# Runs a case or a study from nothing: installs what is missing, builds, starts the processes that the case needs, and
# writes the results with a report. See ./run.sh --help.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

"$root/tools/install.sh" run
! grep -qs -d skip '^ *\[study\]' -- "$@" </dev/null || "$root/tools/install.sh" study
export PYTHONPATH=$root/tools${PYTHONPATH:+:$PYTHONPATH}
case ${1---help} in -h | --help) exec /usr/bin/python3 -m toryu.launch --help ;; esac
if [ -f "$root/build/release/build.ninja" ]; then
  "$root/tools/build.sh" release fluid_solver solid_solver coupler reference_loop
else
  "$root/tools/build.sh" release -DTORYU_TESTS=OFF fluid_solver solid_solver coupler reference_loop
fi
exec /usr/bin/python3 -m toryu.launch "$@"
