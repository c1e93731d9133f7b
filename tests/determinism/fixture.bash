# What the checks of this folder share. To be sourced, after `me` and `program` are set: makes a
# folder for the check to work in, which is gone in the end, and what all is compared with.
# shellcheck shell=bash

program=$(realpath "${program:?}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit

failed() {
  echo "${me:?}: $*" >&2
  exit 1
}

# One output of each kind. Two of H.264: the default is constant quantiser and the fastest preset,
# the other uses all that libx264 decides by itself.
readonly -a outputs=(
  "render --to 9 -o default.mp4"
  "render --to 9 --preset medium -o medium.mp4"
  "render --to 9 --sound -o sound.mp4"
  "render --to 9 -o sound.wav"
  "render --to 9 -o out.y4m"
  "render --to 9 -o out.framehash"
  "render --to 2 -o %03d.png"
  "still --at last -o out.png"
  "still --at last -o out.svg"
  "still --at last -o out.pdf"
  "render --digits 6 --sound -o six.wav"
  "render --digits 2 --slow-motion auto --shutter 1/2 -o slow.framehash"
  "render lecture --no-sound -o lecture.framehash"
  "render turn --no-sound -o turn.framehash"
  "render conservation --no-sound -o conservation.framehash"
  "log --digits 4 -o out.csv"
  "log --digits 4 --format npy -o out.npy"
  "log --digits 6 --format csv -o six.csv"
  "log --digits 4 --engine events -o events.csv"
  "state --digits 1 --at 0,3.5,turn-1/7,turn,last+1 --bounds"
  "state --digits 20 --at 0,3.5,turn-1/7,turn,last+1 --bounds"
  "state --mass-ratio 7/3 --at 0,3.5,turn-1/7,turn,last+1 --bounds"
)
jobs=2

# make_outputs FOLDER COMMAND…: all of them, made in this folder by the program, which COMMAND runs.
make_outputs() {
  local output words
  rm -rf "$1"
  mkdir -p "$1"
  for output in "${outputs[@]}"; do
    read -ra words <<<"$output"
    [[ ${words[0]} == log || ${words[0]} == state ]] || words+=(--size 320x180)
    [[ ${words[0]} != render ]] || words+=(--fps 10 --quiet --jobs "$jobs")
    (cd "$1" && "${@:2}" "$program" "${words[@]}" >>printed 2>errors) ||
      failed "$2 …: $output: $(tail -n 5 "$1/errors")"
    rm "$1/errors"
  done
  # Pixman says on standard output what it was told to leave out.
  sed -i '/^pixman: Disabled /d' "$1/printed"
}

# expect_same WHAT COMMAND…: run by this command the program makes the same files.
expect_same() {
  make_outputs other "${@:2}"
  diff -rq expected other || failed "$1: not the same bytes"
  echo "ok: $1"
}
make_outputs expected env
[[ $(find expected -type f -size +0 | wc -l) -ge 36 ]] || failed "outputs are missing"
