# A bare Debian in a folder, for the checks of this folder. To be sourced, after `me` is set. What it
# makes is gone in the end.
# shellcheck shell=bash

work=$(mktemp -d)
clean_up() {
  local mounted
  while read -r mounted; do umount "$mounted"; done < <(
    awk -v work="$work/" 'index($2, work) == 1 { print $2 }' /proc/mounts | sort -r)
  rm -rf --one-file-system "$work"
}
trap clean_up EXIT

failed() {
  echo "${me:?}: $*" >&2
  exit 1
}

[[ $EUID -eq 0 ]] || failed "has to be run as root"
command -v debootstrap >/dev/null || failed "debootstrap is missing; install the package of that name"

# bare_debian NAME RELEASE ARCHITECTURE: with /proc, and with the host's devices, in $work/NAME.
# Programs of another architecture run in QEMU, where the kernel knows of it (package binfmt-support
# or systemd, and qemu-user-static).
bare_debian() {
  debootstrap --variant=minbase --arch="$3" "$2" "$work/$1" >"$work/debootstrap.log" 2>&1 ||
    failed "debootstrap of $2 for $3: $(tail -n 3 "$work/debootstrap.log")"
  mount -t proc proc "$work/$1/proc"
  mount --bind /dev "$work/$1/dev"
  mount --bind /dev/pts "$work/$1/dev/pts"
}

# in_debian NAME TEXT: runs these commands there, stopping at the first that fails.
in_debian() {
  chroot "$work/$1" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 \
    DEBIAN_FRONTEND=noninteractive bash -euo pipefail -c "$2" </dev/null
}

# timed WHAT COMMAND…: says how long it took, once it has succeeded; what it printed if it fails.
timed() {
  local start=$SECONDS
  if ! "${@:2}" >"$work/log" 2>&1; then
    tail -n 60 "$work/log" >&2
    failed "$1 failed"
  fi
  echo "ok: $1, $((SECONDS - start)) s"
}
