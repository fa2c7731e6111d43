#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# Part of the data that cannot be used, or is not wanted, does not stop a job and is counted.
source "$(dirname -- "$0")/tool_test.sh"
good=$block/trajectory.csv
strips=("$block"/strip[1-4].las)
columns() { awk -F, -v OFS=, "$1" "$good"; }  # the good trajectory through an awk program

# calibrate_with STATUS TEXT ARG…: of boresight angles, which four strips determine.
calibrate_with() {
  expect "$1" "$2" calibrate "${strips[@]}" -output calibration.json \
    -estimate boresight_roll,boresight_pitch "${@:3}"
}
in_json() { check "calibration.json has $1" grep -q "$1" calibration.json; }

# The first strip is flown from 401003 to 401005.25 s.
columns 'NR == 1 || $1 > 401003.1' >late.csv
calibrate_with 0 "left out: measured before the trajectory begins" -trajectory late.csv
in_json '"reason": "before_trajectory"'
columns 'NR == 1 || $1 < 401003.5 || $1 > 401005' >gap.csv
calibrate_with 0 "left out: measured in a gap of the trajectory" -trajectory gap.csv
columns 'NR == 1 || $1 > 401005.2' >second.csv
calibrate_with 0 "the trajectory covers hardly anything of the strip" -trajectory second.csv

calibrate_with 0 "left out: the strip was not chosen" -trajectory "$good" -without 4
in_json '"reason": "excluded"'
check "strip 4 is in no pair" sh -c '! grep -q "\"b\": \"4\"" calibration.json'
calibrate_with 0 "" -trajectory "$good" -strips 1,2,3
# With pairs, the strips that are in none need no trajectory.
calibrate_with 0 "" -trajectory second.csv -pairs 3:4
calibrate_with 2 "no pair is left" -trajectory second.csv -pairs 1:2
calibrate_with 1 "option -without: there is no strip '9'; there are 1, 2, 3, 4" -trajectory "$good" -without 9
calibrate_with 1 "both name strip '1'" -trajectory "$good" -strips 1,2 -without 1
calibrate_with 1 "option -strips: names no strip" -trajectory "$good" -strips ,
calibrate_with 1 "names strip '4', which -strips or -without leaves out" \
  -trajectory "$good" -pairs 3:4 -without 4
calibrate_with 2 "not chosen" -trajectory "$good" -strips 1

expect 0 "left out: the strip was not chosen" check "${strips[@]}" -without 4 -output q.json
check "quality.json counts what was left out" grep -q '"reason": "excluded"' q.json
expect 0 "" check "${strips[@]}" -trajectory second.csv -output q.json

# Flight lines of files without source ids are those of the strips they were cut from.
for i in 1 2 3 4; do "$damage" "${strips[i - 1]}" "id0_$i.las" source_id 0 || failed "damage"; done
expect 0 "" check id0_*.las -split -output split.json
check "four lines" grep -q '"id": "line4"' split.json
finish
