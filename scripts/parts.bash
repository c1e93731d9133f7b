# What the scripts that render in parts share. To be sourced; `me` is the script's name in messages.
# shellcheck shell=bash disable=SC2034 # what is set here is used there

fail() {
  echo "${me:?}: $*" >&2
  exit 1
}

# For wrong usage.
refuse() {
  printf '%s: %s\nRun it with --help for more information.\n' "${me:?}" "$*" >&2
  exit 2
}

# require_number OPTION VALUE: VALUE is a whole number from 1, without a leading zero, since it is
# also part of a file's name.
require_number() {
  [[ $2 =~ ^[1-9][0-9]{0,4}$ ]] || refuse "$1: '$2' is no number from 1 to 99999"
}

# read_rendering OPTION…: sets `output` to the value of -o, from which the names of the parts
# follow, and `quiet` to the option --quiet, if it is there.
read_rendering() {
  output=
  quiet=()
  while [[ $# -gt 0 ]]; do
    case $1 in
      -o | --output)
        output=${2-}
        shift
        ;;
      --output=*) output=${1#*=} ;;
      -o*) output=${1#-o} ;;
      --quiet) quiet=(--quiet) ;;
      --part | --part=*) refuse "--part is not for you to give: each part gets its own" ;;
      --jobs | --jobs=*) refuse "--jobs is not for you to give: each part gets its own" ;;
    esac
    shift || break
  done
  [[ -n $output ]] || refuse "behind '--', -o OUT is missing"
}

# find_program [PATH]: sets `program` to an absolute path, because other machines have to find it
# there too: PATH, or else what 'piblocks' means to the shell, or else what this tree has built.
find_program() {
  local built
  built=$(dirname "${BASH_SOURCE[0]}")/../build/release/piblocks
  if [[ -n ${1-} ]]; then
    program=$(type -P -- "$1") || fail "there is no program '$1'"
  elif ! program=$(type -P piblocks); then
    [[ -x $built ]] || fail "there is no piblocks on the PATH; name it with --program, or build it"
    program=$built
  fi
  program=$(cd -- "$(dirname -- "$program")" && pwd)/${program##*/}
}

# name_parts COUNT: sets `part_files` to the names that the program gives to the parts of `output`,
# counted from 1.
name_parts() {
  local part
  part_files=()
  for ((part = 1; part <= $1; ++part)); do
    part_files[part]=$output.part-$part-of-$1
  done
}

# is_part FILE: whether the program has made this file as a part.
is_part() {
  [[ $(head -c 14 -- "$1" | tr -d '\0') == "piblocks part " ]]
}

# choose_parts RESUME: sets `wanted` to the numbers of the parts to be rendered. A part appears
# under its name only when it is complete, so with RESUME (true or false) those that are there are
# done. Without it none may be left from an earlier run, or a later resumption would take it.
choose_parts() {
  local part
  wanted=()
  for part in "${!part_files[@]}"; do
    [[ ! -e ${part_files[part]} ]] || is_part "${part_files[part]}" ||
      fail "'${part_files[part]}' is there, but not a part file; use another name, or move it away"
    $1 || rm -f -- "${part_files[part]}"
    [[ -e ${part_files[part]} ]] || wanted+=("$part")
  done
}
