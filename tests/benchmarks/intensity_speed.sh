#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# intensity_speed.sh BIN_DIR TRAJECTORY ROUNDS FILE.las…: pcl_als_intensity against cp of the same files, run in turn; the
# best of the rounds, one thread, processor time in milliseconds (a machine that is shared says little of the clock), and memory.
set -euo pipefail
export LC_ALL=C
bin=$1 flight=$2 rounds=$3
shift 3
files=("$@")
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
declare -A best memory
measure() {  # NAME COMMAND…
  local name=$1 kilobytes user system ms
  shift
  rm -rf -- "$work/out" && mkdir "$work/out"
  command time -f '%M %U %S' -o "$work/used" "$@" >/dev/null
  read -r kilobytes user system <"$work/used"
  ms=$(bc -l <<<"1000 * ($user + $system) / 1" | cut -d. -f1)
  [[ -n ${best[$name]:-} && ${best[$name]} -le $ms ]] || best[$name]=$ms
  memory[$name]=$kilobytes
}
run() { measure "$1" "$bin/pcl_als_intensity" "${files[@]}" -corrected "$work/out" -trajectory "$flight" -threads 1 -quiet "${@:2}"; }
for ((round = 0; round < rounds; ++round)); do
  measure cp cp "${files[@]}" "$work/out"
  run no_normals -no_incidence -no_fields -no_original
  run no_fields -no_fields -no_original
  run all
done
printf '%-12s %8s %8s %10s\n' what ms "of cp" "memory MB"
for name in cp no_normals no_fields all; do
  printf '%-12s %8d %8.1f %10d\n' $name "${best[$name]}" "$(bc -l <<<"${best[$name]} / ${best[cp]}")" $((memory[$name] / 1024))
done
