#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# Trajectories, control and calibrations that cannot be used, and those that can be repaired.
source "$(dirname -- "$0")/tool_test.sh"
strip=$block/strip1.las good=$block/trajectory.csv

# apply_with STATUS TEXT TRAJECTORY; a refusal leaves no file.
apply_with() {
  rm -f x.las
  expect "$1" "$2" apply "$strip" x.las -trajectory "$3" -bias boresight_roll=90
  [[ $1 == 0 ]] || absent x.las
}
refused() {  # TRAJECTORY TEXT
  apply_with 2 "$2" "$1"
  expect 2 "$2" calibrate "$strip" "$block/strip2.las" -trajectory "$1" -output x.json
  absent x.json
}
columns() { awk -F, -v OFS=, "$1" "$good"; }  # the good trajectory through an awk program

refused missing.csv "missing.csv"
: >empty.csv; refused empty.csv "empty.csv"
head -1 "$good" >header_only.csv; refused header_only.csv "header_only.csv"
columns 'NR == 1 || NR == 5' >one_sample.csv; refused one_sample.csv "*"
columns '{ $3 = ""; sub(",,", ","); print }' >no_y.csv; refused no_y.csv "no_y.csv*y"
columns 'NR == 7 { $2 = "abc" } { print }' >text.csv; refused text.csv "text.csv*7*x*"
columns 'NR == 7 { $2 = "nan" } { print }' >nan.csv; refused nan.csv "nan.csv*7*"
columns 'NR == 7 { print "1,2"; next } { print }' >short.csv; refused short.csv "short.csv*7*"
columns 'NR > 1 { $1 += 50000 } { print }' >other_time.csv; refused other_time.csv "*time*"
columns 'NR > 1 { $2 = 1; $3 = 2 } { print }' >standing.csv; refused standing.csv "*"
columns 'NR > 1 { $1 = 401000 } { print }' >one_time.csv; refused one_time.csv "*"

# The strip lasts from 401003 to 401005.25 s: a hole in the middle, and an end before it.
columns 'NR == 1 || $1 < 401003.5 || $1 > 401005' >gap.csv; apply_with 2 "*gap*" gap.csv
head -3 "$good" >two_samples.csv; refused two_samples.csv "*trajectory*"
expect 0 "" apply "$strip" kept.las -trajectory gap.csv -bias boresight_roll=90 -keep_uncovered

# Order and duplicates can be repaired: the points are those of the good trajectory.
apply_with 0 "" "$good"; mv x.las good.las
(head -1 "$good"; tail -n +2 "$good" | sort -t, -k5,5 -k1,1r) >unsorted.csv
awk '1; NR > 1 && NR % 3 == 0' "$good" >duplicated.csv
awk -F, -v OFS=';' '{ print $5, $3, $7, $2, $4, $6, $1 }' "$good" >other_columns.csv
for name in unsorted duplicated other_columns; do
  apply_with 0 "" $name.csv
  check "$name.csv gives the same points" cmp good.las x.las
done

rm -f x.las

calibrate=(calibrate "$strip" "$block/strip2.las" -trajectory "$good" -output x.json -control)
expect 2 "missing.csv" "${calibrate[@]}" missing.csv
sed 's/,z/,height/' "$block/control.csv" >no_z.csv; expect 2 "no_z.csv*z" "${calibrate[@]}" no_z.csv
sed '3s/,[0-9.]*,/,east,/' "$block/control.csv" >text_control.csv
expect 2 "text_control.csv*3*" "${calibrate[@]}" text_control.csv
: >empty_control.csv; expect 2 "empty_control.csv" "${calibrate[@]}" empty_control.csv
absent x.json

use=(apply "$strip" x.las -trajectory "$good" -calibration)
expect 2 "missing.json" "${use[@]}" missing.json
: >empty.json; expect 2 "empty.json" "${use[@]}" empty.json
echo '{"format": "pcl_als calibration", "version": 1' >cut.json; expect 2 "cut.json" "${use[@]}" cut.json
echo '{"format": "other"}' >other.json; expect 2 "other.json" "${use[@]}" other.json
absent x.las
finish
