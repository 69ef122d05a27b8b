# Completion for Bash: the options that a command names in its --help, and the words that one of them may have.
_toryu() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} help words=
  help=$("$1" --help 2>/dev/null)
  if [[ $word == -* ]]; then
    words=$(grep -oE -- '--[a-z][a-z-]*' <<<"$help")
  elif [[ $before == --* ]]; then
    words=$(grep -oE -m 1 -- "$before \{[a-z,]*\}" <<<"$help" | tr -c 'a-z-' '\n' | grep -vx -- "$before")
  fi
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word" | sort -u)
}
complete -o default -F _toryu toryu fluid_solver solid_solver coupler
