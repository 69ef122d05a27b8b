#!/usr/bin/env bash
# Runs a case or a study from nothing: installs what is missing, builds what is out of date, starts the processes that
# the case needs, and writes the results with a report. See ./run.sh --help.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

# A descriptor that is closed would be given to the next file that is opened, and take what is meant for a terminal.
[ -e /dev/fd/0 ] || exec 0</dev/null
[ -e /dev/fd/1 ] || exec 1>/dev/null
[ -e /dev/fd/2 ] || exec 2>/dev/null

"$root/tools/install.sh" run
toryu=(/usr/bin/python3 -I -X utf8 "$root/tools/toryu")
case ${1---help} in -h | --help) exec "${toryu[@]}" launch --help ;; esac
targets=(fluid_solver solid_solver coupler replayed_fluid replayed_solid reference_loop)
for word in "$@"; do # a participant in Python
  [[ $word == *.py ]] || continue
  "$root/tools/install.sh" python
  modules=("$root"/build/release/bin/toryu_participant.*.so)
  [ -e "${modules[0]}" ] || targets=(-DTORYU_PYTHON=ON "${targets[@]}")
  targets+=(toryu_participant)
  break
done
"$root/tools/build.sh" release -DTORYU_TESTS?=OFF "${targets[@]}"
if [[ " $* " == *" --ranks"[\ =]* ]]; then # the fluid over MPI has a build of its own
  "$root/tools/install.sh" ranks
  "$root/tools/build.sh" ranks -DTORYU_TESTS?=OFF fluid_solver
fi
exec "${toryu[@]}" launch "$@"
