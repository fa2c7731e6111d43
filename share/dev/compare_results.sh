#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# compare_results.sh BEFORE AFTER FOLDER: runs the tools of two builds (folders with the programs) on a
# small simulated block and compares all JSON, CSV and Markdown files that they write, byte by byte
# (but for reports with run times).
# Results of the first build are kept in FOLDER/before. Ends with status 1 if a file differs.
set -euo pipefail
export LC_ALL=C
before=$(realpath -- "$1") after=$(realpath -- "$2")
mkdir -p -- "$3"
cd -- "$3"
block=$PWD/block

results() {  # BIN: results in the current folder, from the block
  local bin=$1 strips=("$block"/strip?.las)
  # A status other than 0 states a verdict (2 and more), which the files have as well.
  run() { "$bin/pcl_als_$1" "${@:2}" >"$1.log" 2>&1 || echo "$1: status $?"; }
  local trajectory=(-trajectory "$block/trajectory.csv")
  run calibrate "${strips[@]}" "${trajectory[@]}" -control "$block/control.csv" -output calibration.json
  run calibrate "${strips[@]}" "${trajectory[@]}" -prior ../first/calibration.json -own boresight_roll \
    -system a=1,2 -system b=3 -fixed 3 -output with_prior.json
  run apply "${strips[@]}" "${trajectory[@]}" -calibration ../first/calibration.json -force \
    -corrected corrected
  run check "${strips[@]}" "${trajectory[@]}" -control "$block/control.csv" -output quality.json \
    -report quality_report
  run check corrected -before "$block" "${trajectory[@]}" -output both.json -report both_report
  run check "${strips[@]:0:2}" -output two.json
  run info "${strips[@]}" "${trajectory[@]}" -json survey.json
  run intensity "${strips[@]}" -corrected intensity "${trajectory[@]}" -estimate all -json model.json
  printf 'is,a,b\na,40,2\nb,3,50\n' >matrix.csv
  printf 'is,a,b\na,38,4\nb,3,50\n' >other.csv
  run accuracy matrix.csv -compare other.csv -output accuracy.json
}

[[ -e $block ]] ||
  "$before/pcl_als_simulate" -output block -preset small -scale 0.3 -density 0.3 -noise range -seed 5
if [[ ! -e first/calibration.json ]]; then
  mkdir -p first
  "$before/pcl_als_calibrate" "$block"/strip?.las -trajectory "$block/trajectory.csv" \
    -output first/calibration.json >first/log 2>&1 || true
fi
[[ -e before ]] || { mkdir before && (cd before && results "$before"); }
rm -rf after
mkdir after
(cd after && results "$after")

different=0 compared=0
while IFS= read -r file; do
  compared=$((compared + 1))
  cmp -- "before/$file" "after/$file" || different=$((different + 1))
done < <(cd before && find . \( -name '*.json' -o -name '*.csv' -o -name '*.md' \) -not -name run.csv -not -name report.md | sort)
echo "$compared files compared, $different differ"
((different == 0 && compared > 0))
