#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# paper_table4.sh BIN_DIR WORK_DIR [FROM:TO] [simulate options…]
#
# Table 4 of Habib et al. 2011 on simulated blocks, with the tools as a user runs them: roof lines
# of the strips before calibration and after experiments I to IV are the only control of an image
# block, whose check points are compared with their survey. The true ridges as control ("true")
# show what remains of the errors of images and survey. Prints means over the seeds (FROM to TO,
# default 1:3) beside the paper's values as Markdown; the results by seed are in
# WORK_DIR/table4.csv.
set -euo pipefail
export LC_ALL=C
bin=$1 work=$2 seeds=${3:-1:3}
shift $(($# < 3 ? $# : 3))
mkdir -p -- "$work"
all_pairs=1:2,3:4,4:5,5:6

# values FILE KEY: the three numbers of a list in the check points of an orientation.json.
values() {
  awk -v key="\"$2\":" '/"check_points":/ { on = 1 }
    on && $1 == key { take = 3; next }
    take > 0 && /[0-9]/ { sub(",", ""); printf "%s%s", $1, (--take ? "," : "\n"); if (!take) exit }' "$1"
}

# lines STATE STRIP…: lines of the strips, orientation of the images, one row of the table.
lines() {
  local state=$1
  shift
  "$bin/pcl_als_lines" "$@" -quiet -output "$block/lines_$state.csv"
  orient "$state" "$block/lines_$state.csv"
}

# orient STATE LINES: orientation of the images with lines, one row of the table.
orient() {
  local state=$1
  "$bin/pcl_als_orient" -quiet -images "$block/images/images.csv" -camera "$block/images/camera.json" \
    -lines "$2" -checkpoints "$block/images/checkpoints.csv" -assign 4 \
    -output "$block/orientation_$state.json" || echo "seed $seed, $state: status $?" >&2
  local result=$block/orientation_$state.json
  echo "$seed,$state,$(values "$result" mean_m),$(values "$result" std_m),$(values "$result" rmse_m)" \
    >>"$work/table4.csv"
}

# experiment STATE PAIRS CONTROL: calibrates, corrects, orients. CONTROL may be empty.
experiment() {
  local state=$1 pairs=$2 control=$3 strip
  local options=(-trajectory "$block/trajectory.csv" -model quasi_rigorous -pairs "$pairs"
    -output "$block/calibration_$state.json" -quiet)
  [[ -z $control ]] || options+=(-control "$control")
  "$bin/pcl_als_calibrate" "$block"/strip[1-6].las "${options[@]}" ||
    echo "seed $seed, $state: calibration ends with status $?" >&2
  mkdir -p -- "$block/corrected"
  for strip in "$block"/strip[1-6].las; do
    "$bin/pcl_als_apply" "$strip" "$block/corrected/$(basename -- "$strip")" -quiet \
      -trajectory "$block/trajectory.csv" -calibration "$block/calibration_$state.json"
  done
  lines "$state" "$block"/corrected/strip[1-6].las
}

echo "seed,state,mean_x,mean_y,mean_z,std_x,std_y,std_z,rmse_x,rmse_y,rmse_z" >"$work/table4.csv"
for ((seed = ${seeds%:*}; seed <= ${seeds#*:}; ++seed)); do
  block=$work/block
  rm -rf -- "$block"
  "$bin/pcl_als_simulate" -quiet -output "$block" -preset paper -noise realistic -images \
    -seed "$seed" -bias "none,boresight_pitch=-29,boresight_roll=-90,boresight_heading=3,range_bias=0.12,scan_angle_scale=1e-4" "$@"
  # One control point: the nearest to the middle of the block.
  awk -F, 'NR == 1 { print; next } { d = ($2 - 700000) ^ 2 + ($3 - 5660000) ^ 2
    if (best == "" || d < least) { best = $0; least = d } } END { print best }' \
    "$block/control.csv" >"$block/one.csv"
  lines before "$block"/strip[1-6].las
  experiment I "$all_pairs" ""
  experiment II "$all_pairs" "$block/control.csv"
  experiment III "$all_pairs" "$block/one.csv"
  experiment IV 1:2,4:5,5:6 "$block/control.csv"
  orient true "$block/images/true_lines.csv"
  rm -rf -- "$block"/strip*.las "$block/corrected"
done

awk -F, '
  BEGIN {
    columns = split("before I II III IV true", states, " ")
    paper["mean X"] = "-0.03 0.00 0.01 0.03 -0.01"; paper["mean Y"] = "-0.18 0.04 0.03 0.04 -0.01"
    paper["mean Z"] = "0.15 0.13 0.02 -0.01 0.02"; paper["sd X"] = "0.11 0.06 0.06 0.06 0.06"
    paper["sd Y"] = "0.15 0.06 0.07 0.06 0.07"; paper["sd Z"] = "0.17 0.17 0.18 0.17 0.17"
    paper["RMSE X"] = "0.11 0.05 0.06 0.06 0.06"; paper["RMSE Y"] = "0.23 0.07 0.07 0.07 0.07"
    paper["RMSE Z"] = "0.23 0.22 0.17 0.17 0.17"; paper["RMSE total"] = "0.34 0.23 0.20 0.19 0.19"
    paper["RMSE plan"] = "0.25 0.09 0.09 0.08 0.09"
    names = "mean X,mean Y,mean Z,sd X,sd Y,sd Z,RMSE X,RMSE Y,RMSE Z,RMSE plan,RMSE total" }
  NR > 1 && NF == 11 { n[$2]++
    for (i = 3; i <= 5; ++i) sum[$2, i - 2] += $i
    for (i = 6; i <= 11; ++i) sum[$2, i - 2] += $i * $i
    sum[$2, 10] += $9 * $9 + $10 * $10
    sum[$2, 11] += $9 * $9 + $10 * $10 + $11 * $11 }
  END {
    print "| m | before | I | II | III | IV | true |\n|---|---|---|---|---|---|---|"
    count = split(names, name, ",")
    for (r = 1; r <= count; ++r) {
      row = "| " name[r] " |"
      split(paper[name[r]], theirs, " ")
      for (s = 1; s <= columns; ++s) {
        k = n[states[s]]
        v = k ? sum[states[s], r] / k : 0
        if (r > 3) v = sqrt(v)
        row = row sprintf(" %.3f", v) (s < 6 ? " (" theirs[s] ")" : "") " |" }
      print row }
    row = "| RMSE plan, decrease % | |"
    before = sum["before", 10] / n["before"]
    for (s = 2; s <= columns; ++s) {
      share = n[states[s]] ? sqrt(sum[states[s], 10] / n[states[s]] / before) : 1
      row = row sprintf(" %.0f |", 100 * (1 - share)) }
    print row }' "$work/table4.csv"
