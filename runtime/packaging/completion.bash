# Completion of samara's commands, their options and the words that options take, as the programs themselves tell them.
_samara() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} program=${COMP_WORDS[0]} lines names
  if [ "$COMP_CWORD" -eq 1 ]; then
    mapfile -t COMPREPLY < <(compgen -W "$("$program" --list-commands 2>/dev/null)" -- "$word")
    return
  fi
  # Lines of an option's names, then the words that it takes.
  lines=$("$program" "${COMP_WORDS[1]}" --list-options 2>/dev/null)
  names=$(awk -F'\t' -v option="$before" '{ n = split($1, name, " ")
    for (i = 1; i <= n; i++) if (name[i] == option) print $2 }' <<<"$lines")
  if [ -z "$names" ] && [[ $word == -* ]]; then names=$(cut -f1 <<<"$lines"); fi
  if [ -n "$names" ]; then
    mapfile -t COMPREPLY < <(compgen -W "$names" -- "$word")
  else
    compopt -o default
    COMPREPLY=()
  fi
}
complete -F _samara samara
