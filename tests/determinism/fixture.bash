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
  "log --digits 4 -o out.csv"
  "log --digits 4 --format npy -o out.npy"
)
jobs=2

# make_outputs FOLDER COMMAND…: all of them, made in this folder by the program, which COMMAND runs.
make_outputs() {
  local output words
  rm -rf "$1"
  mkdir -p "$1"
  for output in "${outputs[@]}"; do
    read -ra words <<<"$output"
    [[ ${words[0]} == log ]] || words+=(--size 320x180)
    [[ ${words[0]} != render ]] || words+=(--fps 10 --quiet --jobs "$jobs")
    (cd "$1" && "${@:2}" "$program" "${words[@]}" >errors 2>&1) ||
      failed "$2 …: $output: $(tail -n 5 "$1/errors")"
    rm "$1/errors"
  done
}

# expect_same WHAT COMMAND…: run by this command the program makes the same files.
expect_same() {
  make_outputs other "${@:2}"
  diff -rq "${but_for[@]}" expected other || failed "$1: not the same bytes"
  echo "ok: $1"
}
but_for=()

# expect_same_pictures WHAT COMMAND…: the same, but for the logs. With fused multiply-adds glibc's
# sine and cosine round otherwise now and then, and the last digit of a log's numbers shows it. Of
# 30,000 frames that were compared, up to 20 digits and at the turn, none did.
expect_same_pictures() {
  local but_for=(--exclude='out.csv' --exclude='out.npy')
  expect_same "$@"
}

make_outputs expected env
[[ $(find expected -type f -size +0 | wc -l) -ge 25 ]] || failed "outputs are missing"
