#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# pictures_speed.sh BIN_DIR FILE.las… [ROUNDS=3 in the environment]: pcl_als_view and pcl_als_profile of all files together.
# Best of the rounds: seconds on the clock and of processors, memory, MB.
set -euo pipefail
export LC_ALL=C
unset DISPLAY
bin=$1
shift
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
measure() {  # NAME COMMAND…
  local name=$1 round seconds cpu memory best=999999 line=
  shift
  for ((round = 0; round < ${ROUNDS:-3}; ++round)); do
    command time -f '%e %U %S %M' -o "$work/used" "$@" >/dev/null
    read -r seconds user system memory <"$work/used"
    cpu=$(bc -l <<<"$user + $system")
    [[ $(bc -l <<<"$seconds < $best") == 1 ]] || continue
    best=$seconds
    line=$(printf '%-28s %7.1f %7.1f %7d' "$name" "$seconds" "$cpu" $((memory / 1024)))
  done
  echo "$line"
}
printf '%-28s %7s %7s %7s\n' what seconds cpu "MB"
measure "top view, hillshade" "$bin/pcl_als_view" "$@" -output "$work/a.png" -shade hill -quiet
measure "oblique, eye-dome" "$bin/pcl_als_view" "$@" -output "$work/b.png" -azimuth 30 -elevation 35 -shade edl -quiet
measure "by strip" "$bin/pcl_als_view" "$@" -output "$work/c.png" -color strip -quiet
measure "4000 x 4000 pixels" "$bin/pcl_als_view" "$@" -output "$work/d.png" -size 4000x4000 -quiet
measure "profile -auto 3" "$bin/pcl_als_profile" "$@" -auto 3 -output "$work/profiles" -quiet
