#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# test_history.sh BIN_DIR SCRATCH_DIR: pcl_als_history as a user runs it, with good and bad input.
source "$(dirname -- "${BASH_SOURCE[0]}")/tool_test.sh"

# Three calibrations of the small block: of all strips, and of parts of them.
calibration() {  # NAME OPTION…
  check "calibration $1" "$bin/pcl_als_calibrate" "$block"/strip*.las -trajectory \
    "$block/trajectory.csv" -control "$block/control.csv" -model rigorous -quiet -output "$1.json" \
    "${@:2}"
}
calibration c1 -gps_week 2200 -system_name 'scanner 12'
# Second 401003 of week 2200, which begins on 2022-03-06.
check "the day of the flight" grep -q '"date": "2022-03-10"' c1.json
check "the name of the system" grep -q '"system_name": "scanner 12"' c1.json
cp c1.json copy.json
# The others differ by what is written into them: roll and its date.
moved() {  # FILE ROLL ID: the same calibration with another roll
  awk -v roll="$2" '/"boresight_roll": \{/ { at = 1 }
    at && /"bias"/ { sub(/: [-0-9.e]+/, ": " roll); at = 0 } { print }' c1.json >"$1"
}
for i in 2 3 4; do moved "c$i.json" "-90.$i"; done
for i in 5 6 7 8; do moved "c$i.json" "-30.$i"; done
printf 'calibration,date,temperature\n' >missions.csv
for i in 1 2 3 4 5 6 7 8; do printf 'c%d.json,2026-0%d-04,%d\n' "$i" "$i" $((10 + i % 3)); done \
  >>missions.csv

printf 'calibration\nother.json\n' >short.csv
expect 1 'usage' history
expect 1 'option -output is needed' history c1.json
expect 1 'level' history c1.json -output h.json -level 2
expect 1 'change' history c1.json -output h.json -change wobble=1
expect 2 'none.json: *there is no such file' history none.json -output h.json
expect 2 'no row for the calibration c1.json' history c1.json -missions short.csv -output h.json
: >empty.json
expect 2 'empty.json: ' history empty.json -output h.json
head -c 2000 c1.json >cut.json
expect 2 'cut.json: ' history c1.json cut.json -output h.json
absent h.json
expect 1 'c1.json' history c1.json -output c1.json

expect 0 'History of 1 calibration' history c1.json -output one.json
expect 0 'copy.json: not used, it repeats another calibration' history c1.json copy.json \
  -output one.json
expect 0 'boresight_roll changed by' history c[1-8].json -missions missions.csv \
  -output history.json -report report
check "the step is between its flights" grep -q 'between 2026-04-04 and 2026-05-04' history.json
check "a control chart for each parameter" grep -q 'History of boresight roll' report/report.html
for file in report/report.md report/parameters.csv report/segments.csv report/missions.csv; do
  check "$file is there" test -s "$file"
done
# The combination is a calibration that apply reads.
check "the pooled roll is that after the step" awk '/"instrument"/ { part = 1 }
  part && /"boresight_roll": \{/ { at = 1 }
  at && /"bias"/ { gsub(/[^-0-9.e]/, ""); exit !($0 + 0 > -31 && $0 + 0 < -30) }' history.json
finish
