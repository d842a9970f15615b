#!/usr/bin/env bash
# A sweep on a disk that is full, and on one that may not be written to: nothing is lost, and where it goes
# on it ends in the same bytes as elsewhere.
#
#     tests/disk.sh VINESINK
#
# Runs as root on Linux: the disk is kept in memory, in a mount namespace that ends with this script.
set -euo pipefail

vinesink="$(realpath "${1:?usage: tests/disk.sh VINESINK}")"
shipped="$(realpath "$(dirname "$0")/../cases/li2016-map.toml")"
if [ "$(id -u)" != 0 ]; then
    echo "FAILED: only root can mount a disk of a given size" >&2
    exit 1
fi
if [ "${2:-}" != inside ]; then
    exec unshare --mount -- "$0" "$vinesink" inside
fi

folder="$(mktemp -d)"
disk="$folder/disk"
end() {
    cd /
    umount "$disk" 2>/dev/null || true
    rm -rf "$folder"
}
trap end EXIT

fail() {
    echo "FAILED: $1" >&2
    exit 1
}

# Runs a command that must end with an exit code; what it says is in $said, with line breaks undone.
ends_with() {
    local wanted="$1" found=0
    shift
    said="$("$@" 2>&1)" || found=$?
    said="$(echo "$said" | sed 's/│//g' | tr '\n' ' ' | tr -s ' ')"
    [ "$found" = "$wanted" ] || fail "$* ended with $found and not $wanted: $said"
}

says() {
    case "$said" in
        *"$1"*) ;;
        *) fail "\"$1\" is not in: $said" ;;
    esac
}

# How many chunks are there.
there() {
    "$vinesink" sweep status map.toml | cut -d ' ' -f 1
}

grep -qx '\[sweep\]' "$shipped" || fail "$shipped has no line [sweep] that its design ends at"
# 64 chunks of 1024 points; some 2 MB, and as much again when they are together.
case="$(sed '/^\[sweep\]$/,$d' "$shipped")
[sweep]
starts = 1
periods = 48
clearance = { from = \"5 mm\", to = \"40 mm\", count = 256 }
frequency = { from = \"8 Hz\", to = \"8.7 Hz\", count = 256 }"

mkdir "$folder/elsewhere" "$disk"
cd "$folder/elsewhere"
echo "$case" >map.toml
ends_with 0 "$vinesink" sweep map.toml
wanted="$folder/elsewhere/sweeps/map/sweep.parquet"
all="$(there)"

mount -t tmpfs -o size=1m vinesink-disk "$disk"
cd "$disk"
echo "$case" >map.toml
ends_with 2 "$vinesink" sweep map.toml
says "what was worked out is kept"
says "sweeps/map/chunks/0000000"
says "No space left"
says "make room"
full="$(there || true)"
[ "$full" -gt 5 ] || fail "of a megabyte $full chunks are kept"
[ "$full" -lt "$all" ] || fail "all chunks fit on the small disk"
echo "full disk: $full of $all chunks are kept"

mount -o remount,ro "$disk"
ends_with 2 "$vinesink" sweep map.toml
says "what was worked out is kept"
says "sweeps/map/chunks/0000000"
says "Read-only file system"
says "write to another one"
[ "$(there || true)" = "$full" ] || fail "a read-only disk lost chunks"
echo "read-only disk: as many"

# Room for all chunks, but not for the file of all of them.
room="$(du --block-size=1K --summarize "$folder/elsewhere/sweeps/map/chunks" | cut -f 1)"
mount -o remount,rw,size=$((room + 300))k "$disk"
ends_with 0 "$vinesink" sweep run map.toml
ends_with 2 "$vinesink" sweep merge map.toml
says "sweeps/map/sweep.parquet"
says "No space left"
[ ! -e sweeps/map/sweep.parquet ] || fail "part of a merged file is left"
[ "$(there)" = "$all" ] || fail "merging lost chunks"
echo "no room to merge: all $all chunks are kept"

mount -o remount,size=64m "$disk"
ends_with 0 "$vinesink" sweep map.toml
cmp sweeps/map/sweep.parquet "$wanted" || fail "the file differs"
left="$(find sweeps -name '.*' | head -n 3)"
[ -z "$left" ] || fail "files in the making are left: $left"
echo "enlarged disk: the same $(stat -c %s "$wanted") bytes as elsewhere"
