#!/usr/bin/env bash
# Checks the C++ code without running it: the format of every file, and clang-tidy (.clang-tidy) on the programs' files.
#   tools/check_code.sh         clang-tidy on what the branch changes: since it left main, or on main in its last commit
#   tools/check_code.sh --all   clang-tidy on every file, some six minutes on two cores
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
case ${1-} in
  "" | --all) ;;
  *)
    echo "check_code.sh: unknown option '$1'; --all or none" >&2
    exit 2
    ;;
esac
start=$SECONDS
tools/install.sh run python test ci

git ls-files '*.hpp' '*.cpp' '*.ipp' | xargs clang-format-14 --dry-run -Werror

sources() { git ls-files '*.cpp' | grep -v '^tests/'; }
# The commit that the branch is compared with. A copy without history has none.
base() {
  local main commit
  for main in origin/main main; do
    commit=$(git merge-base HEAD "$main" 2>/dev/null) || continue
    [ "$commit" != "$(git rev-parse HEAD)" ] || break
    echo "$commit"
    return
  done
  git rev-parse --quiet --verify HEAD^
}
# A file that reads the header $1: its own, or any.
reader() {
  local own=${1%.*}.cpp headers=("$1") header includes files
  if [ -f "$own" ]; then
    echo "$own"
    return
  fi
  while [ ${#headers[@]} -gt 0 ]; do
    includes=()
    for header in "${headers[@]}"; do includes+=(-e "#include \"$header\""); done
    if files=$(git grep -lF "${includes[@]}" -- '*.cpp' ':!tests'); then
      head -1 <<<"$files"
      return
    fi
    mapfile -t headers < <(git grep -lF "${includes[@]}" -- '*.hpp' '*.ipp' ':!tests')
  done
}

if [ "${1-}" = --all ]; then
  mapfile -t files < <(sources)
elif commit=$(base); then
  mapfile -t files < <(git diff --name-only --diff-filter=d "$commit" -- '*.cpp' '*.hpp' '*.ipp' ':!tests' | while read -r file; do
    case $file in *.cpp) echo "$file" ;; *) reader "$file" ;; esac
  done | sort -u)
else
  echo "check_code.sh: no history to compare with, clang-tidy is left out; --all checks every file" >&2
  files=()
fi
if [ ${#files[@]} -gt 0 ]; then
  tools/build.sh clang-v3 -DTORYU_TESTS=ON -DTORYU_PYTHON=ON -DTORYU_WARNINGS_AS_ERRORS=ON toryu_headers toryu_topics toryu_commit
  # What only a build over ranks compiles has no command there.
  mapfile -t files < <(for file in "${files[@]}"; do
    ! grep -qF "/$file\"" build/clang-v3/compile_commands.json || echo "$file"
  done)
  printf '%s\n' "${files[@]}" | xargs -r -P "$(nproc)" -n 1 clang-tidy-14 -p build/clang-v3 --quiet 2> >(grep -v 'warnings generated' >&2)
fi
echo "The format of all files and clang-tidy on ${#files[@]} of $(sources | wc -l) pass, in $((SECONDS - start)) s"
