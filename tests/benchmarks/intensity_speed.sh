#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# intensity_speed.sh BIN_DIR TRAJECTORY ROUNDS FILE.las…: pcl_als_intensity against cp of the same files, run in turn; the
# best of the rounds: processor time in milliseconds (a machine that is shared says little of the clock), time by the clock,
# and memory. One thread; no_normals also with two. RANGE_ONLY=1 leaves out what finds normals.
set -euo pipefail
export LC_ALL=C
bin=$1 flight=$2 rounds=$3
shift 3
files=("$@")
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
declare -A best clock memory
measure() {  # NAME COMMAND…
  local name=$1 kilobytes user system elapsed ms
  shift
  rm -rf -- "$work/out" && mkdir "$work/out"
  command time -f '%M %U %S %e' -o "$work/used" "$@" >/dev/null
  read -r kilobytes user system elapsed <"$work/used"
  ms=$(bc -l <<<"1000 * ($user + $system) / 1" | cut -d. -f1)
  [[ -n ${best[$name]:-} && ${best[$name]} -le $ms ]] || best[$name]=$ms
  ms=$(bc -l <<<"1000 * $elapsed / 1" | cut -d. -f1)
  [[ -n ${clock[$name]:-} && ${clock[$name]} -le $ms ]] || clock[$name]=$ms
  memory[$name]=$kilobytes
}
run() {  # NAME THREADS OPTION…
  measure "$1" "$bin/pcl_als_intensity" "${files[@]}" -corrected "$work/out" -trajectory "$flight" -threads "$2" -quiet "${@:3}"
}
for ((round = 0; round < rounds; ++round)); do
  measure cp cp "${files[@]}" "$work/out"
  run no_normals 1 -no_incidence -no_fields -no_original
  run two_threads 2 -no_incidence -no_fields -no_original
  [[ -n ${RANGE_ONLY:-} ]] && continue
  run no_fields 1 -no_fields -no_original
  run all 1
done
printf '%-12s %8s %8s %8s %8s %10s\n' what ms "of cp" clock "of cp" "memory MB"
for name in cp no_normals two_threads no_fields all; do
  [[ -n ${best[$name]:-} ]] || continue
  printf '%-12s %8d %8.1f %8d %8.1f %10d\n' $name "${best[$name]}" "$(bc -l <<<"${best[$name]} / ${best[cp]}")" \
    "${clock[$name]}" "$(bc -l <<<"${clock[$name]} / ${clock[cp]}")" $((memory[$name] / 1024))
done
