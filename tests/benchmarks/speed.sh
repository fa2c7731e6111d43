#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# speed.sh BEFORE AFTER BLOCK… [ROUNDS=3, THREADS=1 in the environment]: user time and memory of the main tools of two
# installations or build folders (with bin and lib inside), run in turn: a release against the last one. A block is a folder
# with point files (.las, .laz), and with trajectory.csv and control.csv where it has them; without a trajectory, calibrate,
# apply and intensity are not run. Medians of the rounds; apply also against cp of the same files. A tool that fails ends
# the run with its messages.
set -euo pipefail
export LC_ALL=C
if (($# < 3)); then
  sed -n '5,9s/^# //p' "$0"
  exit 1
fi
versions=("$1" "$2")
shift 2
rounds=${ROUNDS:-3} threads=${THREADS:-1}
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT

measure() {  # NAME COMMAND…: adds "seconds megabytes" to the file of the name; with exit status 3 there is a result, too
  local name=$1 status=0 kilobytes user
  shift
  rm -rf -- "$work/out" && mkdir "$work/out"
  command time -q -f '%U %M' -o "$work/used" "$@" >"$work/log" 2>&1 || status=$?
  if ((status != 0 && status != 3)); then
    echo "$*: exit status $status" >&2
    cat "$work/log" >&2
    exit 1
  fi
  read -r user kilobytes <"$work/used"
  echo "$user $((kilobytes / 1024))" >>"$work/$name"
}

tool() {  # VERSION NAME TOOL ARGUMENT…
  local version=$1 name=$2
  measure "$name.$version" env "LD_LIBRARY_PATH=${versions[$version]}/lib" "${versions[$version]}/bin/pcl_als_$3" "${@:4}" \
    -threads "$threads" -quiet
}

runTools() {  # VERSION: the tools with one version, on the files of the block
  local control=() flight=(-trajectory "$block/trajectory.csv")
  [[ -f $block/control.csv ]] && control=(-control "$block/control.csv")
  tool "$1" check check "${files[@]}" "${control[@]}" -output "$work/out/quality.json"
  tool "$1" report check "${files[@]}" "${control[@]}" -output "$work/out/quality.json" -report "$work/out/report"
  tool "$1" trajectory trajectory "${files[@]}" -output "$work/out/trajectory.csv"
  [[ -f $block/trajectory.csv ]] || return 0
  tool "$1" calibrate calibrate "${files[@]}" "${flight[@]}" "${control[@]}" -output "$work/calibration.json"
  tool "$1" apply apply "${files[@]}" -corrected "$work/out" "${flight[@]}" -calibration "$work/calibration.json"
  tool "$1" intensity intensity "${files[@]}" -corrected "$work/out" "${flight[@]}"
}

median() {  # FILE COLUMN
  sort -n -k "$2,$2" "$1" | awk -v column="$2" '{ value[NR] = $column } END { print value[int((NR + 1) / 2)] }'
}

row() {  # NAME BEFORE AFTER: files of measurements
  local seconds=() memory=() file
  for file in "$2" "$3"; do
    seconds+=("$(median "$file" 1)") memory+=("$(median "$file" 2)")
  done
  awk -v name="$1" -v a="${seconds[0]}" -v b="${seconds[1]}" -v m="${memory[0]}" -v n="${memory[1]}" 'BEGIN {
    printf "| %s | %.2f | %.2f | %s | %d | %d |\n", name, a, b, a > 0 ? sprintf("%.2f", b / a) : "-", m, n }'
}

for block; do
  shopt -s nullglob nocaseglob
  files=("$block"/*.las "$block"/*.laz)
  shopt -u nullglob nocaseglob
  ((${#files[@]} > 0)) || { echo "$block: no point files" >&2 && exit 2; }
  rm -f -- "$work"/*.[01] "$work/cp"
  for ((round = 0; round < rounds; ++round)); do
    runTools 0
    runTools 1
    measure cp cp "${files[@]}" "$work/out"
  done
  printf '%s\n\n' "$block: ${#files[@]} files, user seconds and megabytes, medians of $rounds rounds, $threads thread(s)"
  printf '| tool | s before | s after | ratio | MB before | MB after |\n|---|---|---|---|---|---|\n'
  for name in check report trajectory calibrate apply intensity; do
    [[ -f $work/$name.0 ]] && row $name "$work/$name.0" "$work/$name.1"
  done
  row 'apply against cp (before: cp)' "$work/cp" "$([[ -f $work/apply.1 ]] && echo "$work/apply.1" || echo "$work/cp")"
  echo
done
