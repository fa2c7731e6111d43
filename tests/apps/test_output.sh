#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# Outputs that cannot be written, and tools that are killed: nothing half written, inputs untouched.
source "$(dirname -- "$0")/tool_test.sh"
strip=$block/strip1.las
with=(-trajectory "$block/trajectory.csv")
biases=("${with[@]}" -bias boresight_roll=90)
pair=("$block/strip1.las" "$block/strip2.las")

# in_mount OPTIONS COMMAND…: the command with a small file system at ./disk that goes away with it;
# false where mounting is not possible.
in_mount() {
  local options=$1
  shift
  mkdir -p disk
  unshare -m bash -c 'mount -t tmpfs -o "$0" none disk && exec "$@"' "$options" "$@"
}
skipped() { echo "SKIPPED: $1"; }
# quiet_fail TOOL TEXT: what in_mount left in err.txt is one line of that tool with TEXT, status 2.
said() {
  checks=$((checks + 1))
  [[ $status == 2 && $(wc -l <err.txt) == 1 && $(<err.txt) == "pcl_als_$1: "*$2* ]] ||
    failed "pcl_als_$1: status $status, expected 2 and '$2'"
}

# Folders that do not exist, and files in the place of folders.
expect 2 "nowhere/x.las" apply "$strip" nowhere/x.las "${biases[@]}"
expect 2 "nowhere/x.json" calibrate "${pair[@]}" "${with[@]}" -output nowhere/x.json
touch file
expect 2 "file/x.las" apply "$strip" file/x.las "${biases[@]}"
expect 2 "file" calibrate "${pair[@]}" "${with[@]}" -output x.json -corrected file
expect 2 "file" simulate -output file -preset small -scale 0.1 -density 0.1
expect 2 "file/block" simulate -output file/block -preset small -scale 0.1 -density 0.1
# A folder with the name of a preset is no input.
mkdir dual
expect 0 "" simulate -output dual -preset dual -scale 0.1 -density 0.05
rm -rf dual
rm -f x.json
expect 1 "/dev/full: the name does not end in .las" apply "$strip" /dev/full "${biases[@]}"
ln -s /dev/full full.las
expect 2 "full.las: is not a regular file" apply "$strip" full.las "${biases[@]}"
rm full.las
check "nothing else was made" test "$(ls -A | tr '\n' ' ')" = "err.txt file out.txt "

# A file that is there already stays as it was when the new one fails.
echo old >x.las
expect 2 "" apply "$block/control.csv" x.las "${biases[@]}"
check "old output kept" grep -qx old x.las
rm x.las

# Read-only (as root only a mount is read-only) and full disks.
if in_mount size=100k true 2>/dev/null; then
  status=0; in_mount ro "$bin/pcl_als_apply" "$strip" disk/x.las "${biases[@]}" >out.txt 2>err.txt || status=$?
  said apply "disk/x.las"
  status=0; in_mount ro "$bin/pcl_als_calibrate" "${pair[@]}" "${with[@]}" -output disk/x.json >out.txt 2>err.txt || status=$?
  said calibrate "disk/x.json"
  status=0; in_mount ro "$bin/pcl_als_simulate" -output disk/block -preset small -scale 0.1 >out.txt 2>err.txt || status=$?
  said simulate "disk/block"
  left='"$@"; status=$?; ls -A disk | grep -v other | sed "s/^/left: /" >&2; exit $status'
  for size in 100k 400k; do
    status=0
    in_mount size=$size bash -c "$left" - "$bin/pcl_als_apply" "$strip" disk/x.las "${biases[@]}" >out.txt 2>err.txt || status=$?
    said apply "disk/x.las*disk is full"
  done
  status=0
  in_mount size=4k bash -c "echo full >disk/other; $left" - "$bin/pcl_als_calibrate" "${pair[@]}" "${with[@]}" -output disk/x.json >out.txt 2>err.txt || status=$?
  said calibrate "disk/x.json*disk is full"
else
  skipped "read-only folder and full disk: mounting needs root"
fi

# A limit on file sizes (quota) is an error line as well, not a signal.
status=0
(trap '' XFSZ; ulimit -f 100; exec "$bin/pcl_als_apply" "$strip" x.las "${biases[@]}") >out.txt 2>err.txt || status=$?
said apply "x.las*"
absent x.las

# Killed while writing. The tool is stopped as soon as its temporary file shows.
"$bin/pcl_als_simulate" -output large -preset small -quiet || failed "simulate"
large=large/strip1.las
start_and_stop() {  # PATTERN OF THE TEMPORARY, COMMAND…: sets $pid; true if it was caught at work
  local pattern=$1 attempt
  shift
  for attempt in {1..20}; do
    "$@" >out.txt 2>err.txt </dev/null &
    pid=$!
    until compgen -G "$pattern" >/dev/null || ! kill -0 $pid 2>/dev/null; do :; done
    kill -STOP $pid 2>/dev/null && compgen -G "$pattern" >/dev/null && return 0
    kill -CONT $pid 2>/dev/null
    wait $pid 2>/dev/null
    rm -rf made* x.las*
  done
  return 1
}
killed() {  # SIGNAL FINAL PATTERN COMMAND…
  local signal=$1 final=$2 pattern=$3
  shift 3
  if ! start_and_stop "$pattern" "$@"; then skipped "killed with $signal: too quick"; return; fi
  checks=$((checks + 1))
  [[ ! -e $final ]] || failed "$final is there before it is complete"
  kill "-$signal" $pid
  kill -CONT $pid 2>/dev/null
  wait $pid 2>/dev/null
  status=$?
  ((status > 128)) || failed "$1 after $signal: status $status"
  [[ ! -e $final ]] || failed "$final is there after $signal"
  [[ $signal == KILL ]] || ! compgen -G "$pattern" >/dev/null || failed "$signal left a temporary"
  rm -rf made* x.las*
}
for signal in TERM HUP KILL; do  # a shell lets its background jobs ignore INT
  killed $signal x.las 'x.las*.partial' "$bin/pcl_als_apply" "$large" x.las \
    -trajectory large/trajectory.csv -bias boresight_roll=90
  killed $signal made/strip1.las 'made/strip1.las*.partial' "$bin/pcl_als_simulate" -output made -preset small
done
check "input untouched" test -s "$large"
finish
