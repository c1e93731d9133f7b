# What the checks of this folder share. To be sourced, after `me` and `program` are set: makes a
# folder, whose path needs quoting, for the check to work in. In the end all that was started is
# stopped, and the folder is gone.
# shellcheck shell=bash disable=SC2034 # what is set here is used there

clean_up() {
  local log
  [[ ${#children[@]} -eq 0 ]] || kill "${children[@]}" 2>/dev/null || true
  wait
  for log in "$work"/*.log; do
    [[ $1 -eq 0 || ! -e $log ]] || tail -n 50 "$log" | sed "s|^|${log##*/}: |" >&2
  done
  rm -rf "$work"
}

scripts=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../../scripts")
program=$(realpath "${program:?}")
work=$(mktemp -d)
children=()
trap 'clean_up $?' EXIT
mkdir "$work/two words"
cd "$work/two words" || exit

readonly scene="it's {} & \"\$HOME\" %06d.toml"
echo 'red.mass = 100' >"$scene"
# Twenty chunks: more than parts.
readonly rendering=("$scene" --size 160x90 --fps 10 --speed 1/4)
# Hours of work, however fast our own encoder becomes.
readonly endless=("$scene" --smallest --speed 1/5000 --to 3)
readonly out="out {}/%.mp4"

# The program, which notes its process and the way that ssh has come, if it has.
cat >"$work/noting" <<EOF
#!/usr/bin/env bash
echo "\$\$ \${SSH_CONNECTION-}" >>"$work/notes"
exec $(printf %q "$program") "\$@"
EOF
chmod +x "$work/noting"

# make_broken PART: the same, but it fails for this part, as $work/broken-PART.
make_broken() {
  cat >"$work/broken-$1" <<EOF
#!/usr/bin/env bash
if [[ " \$* " == *" --part $1/"* ]]; then
  echo "part $1 is broken" >&2
  exit 1
fi
exec "$work/noting" "\$@"
EOF
  chmod +x "$work/broken-$1"
}
make_broken 1
make_broken 2

failed() {
  echo "${me:?}: $*" >&2
  exit 1
}

# expect_same WHAT: the output is there, as a single run writes it, and nothing beside it.
expect_same() {
  cmp single.mp4 "$out" || failed "$1: not the bytes of a single run"
  [[ $(ls -A "${out%/*}") == "${out##*/}" ]] || failed "$1: left behind: $(ls -A "${out%/*}")"
  rm "$out"
  echo "ok: $1"
}

# wait_until COMMAND…: fails if the command does not succeed within a minute.
wait_until() {
  local end=$((SECONDS + 60))
  until "$@" 2>/dev/null; do
    [[ $SECONDS -lt $end ]] || failed "waited in vain for: $*"
    sleep 0.1
  done
}

is_gone() { ! kill -0 "$1"; }

# Waits until none of the noted processes is left. On another host they end a moment after ssh.
wait_until_all_gone() {
  local process
  while read -r process _; do wait_until is_gone "$process"; done <"$work/notes"
}

# expect_failure WHAT MESSAGE COMMAND…: it fails with MESSAGE among its errors, and leaves neither
# an output nor a process.
expect_failure() {
  local status=0
  : >"$work/notes"
  "${@:3}" 2>errors || status=$?
  [[ $status -ne 0 ]] || failed "$1: succeeded"
  grep -qF -- "$2" errors || failed "$1: does not say '$2', but: $(cat errors)"
  wait_until_all_gone
  [[ ! -e $out ]] || failed "$1: there is an output"
  echo "ok: $1"
}

# expect_interruption WHAT COMMAND…: the command, which renders "endless" with the program "noting",
# leaves no process and no file when it is told to stop.
expect_interruption() {
  local runner status=0
  : >"$work/notes"
  "${@:2}" 2>errors &
  runner=$!
  children+=("$runner")
  wait_until test -s "$work/notes"
  kill -TERM "$runner" || failed "$1: ended too early: $(cat errors)"
  wait "$runner" || status=$?
  [[ $status -eq 143 ]] || failed "$1: ended with $status"
  grep -qF interrupted errors || failed "$1: does not say so, but: $(cat errors)"
  wait_until_all_gone
  [[ -z $(ls -A "${out%/*}") ]] || failed "$1: left behind: $(ls -A "${out%/*}")"
  echo "ok: $1"
}

# start_daemon NAME COMMAND…: in the background, with its messages in a log.
start_daemon() {
  "${@:2}" >"$work/$1.log" 2>&1 &
  children+=($!)
}

# Whether somebody listens at this port of this machine.
is_port_taken() {
  (: <"/dev/tcp/127.0.0.1/$1") 2>/dev/null
}

# find_port: prints a port at which nobody listens.
find_port() {
  local port
  until port=$((20000 + RANDOM % 10000)) && ! is_port_taken "$port"; do :; done
  echo "$port"
}

"$program" render --quiet "${rendering[@]}" -o single.mp4
