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
calibrate_with 0 "excluded: measured before the trajectory begins" -trajectory late.csv
in_json '"reason": "before_trajectory"'
columns 'NR == 1 || $1 < 401003.5 || $1 > 401005' >gap.csv
calibrate_with 0 "excluded: measured in a gap of the trajectory" -trajectory gap.csv
columns 'NR == 1 || $1 > 401005.2' >second.csv
calibrate_with 0 "the trajectory covers hardly anything of the strip" -trajectory second.csv

calibrate_with 0 "excluded: the strip was not chosen" -trajectory "$good" -without 4
in_json '"reason": "excluded"'
check "strip 4 is in no pair" sh -c '! grep -q "\"b\": \"4\"" calibration.json'
calibrate_with 0 "" -trajectory "$good" -strips 1,2,3
# With pairs, the strips that are in none need no trajectory.
calibrate_with 0 "" -trajectory second.csv -pairs 3:4
calibrate_with 2 "no pair is left" -trajectory second.csv -pairs 1:2
calibrate_with 1 "option -without: there is no strip '9'; there are 1, 2, 3, 4" -trajectory "$good" -without 9
calibrate_with 1 "both name strip '1'" -trajectory "$good" -strips 1,2 -without 1
calibrate_with 1 "option -strips: names no strip" -trajectory "$good" -strips ,
calibrate_with 1 "pairs: strip '4' is not among the strips in use; -strips and -without" \
  -trajectory "$good" -pairs 3:4 -without 4
calibrate_with 2 "not chosen" -trajectory "$good" -strips 1

expect 0 "excluded: the strip was not chosen" check "${strips[@]}" -without 4 -output q.json
check "quality.json counts what was excluded" grep -q '"reason": "excluded"' q.json
expect 0 "" check "${strips[@]}" -trajectory second.csv -output q.json

# Flight lines of files without source ids are those of the strips they were cut from.
for i in 1 2 3 4; do "$damage" "${strips[i - 1]}" "id0_$i.las" source_id 0 || failed "damage"; done
expect 0 "" check id0_*.las -split -output split.json
check "four lines" grep -q '"id": "line4"' split.json

# The other tools: strips by name, flight lines, several flights in one file, points without a time.
left_out() {  # FILE STRIP REASON: the result counts points of that strip
  check "$1: $2 is excluded: $3" awk -v strip="\"$2\"," -v reason="\"$3\"," '
    $1 == "\"strip\":" { on = $2 == strip } on && $1 == "\"reason\":" && $2 == reason { found = 1 }
    END { exit !found }' "$1"
}
expect 0 "line4" info id0_*.las -split -without line2 -output info.json
left_out info.json line2 excluded
check "line2 is no strip of the inventory" sh -c '! grep -q "\"id\": \"line2\"" info.json'
expect 0 "the strip was not chosen" info "${strips[@]}" -strips 1,3 -output info.json
left_out info.json 2 excluded
expect 1 "option -strips: there is no strip 'x'; there are 1, 2, 3, 4" info "${strips[@]}" -strips x

expect 0 "the strip was not chosen" icpatch id0_*.las -split -without line4 -pair line1:line2 \
  -output lines.json
left_out lines.json line4 excluded
expect 0 "" icpatch "${strips[@]}" -pair 1:2 -output pair.json
check "lines are aligned as the strips they were cut from" cmp \
  <(sed -n '/"centroid"/,$p' lines.json) <(sed -n '/"centroid"/,$p' pair.json)
expect 1 "option -pair: there is no strip 'line9'" icpatch id0_*.las -split -pair line1:line9 -output x.json
expect 2 "no strip is left" icpatch id0_*.las -split -without line1,line2,line3,line4 \
  -pair line1:line2 -output x.json
absent x.json

# Several flight lines under one id are divided where they are compared with each other, and named where they are not.
"$damage" "${strips[0]}" id7.las append "${strips[1]}" append "${strips[2]}" append "${strips[3]}" source_id 7 ||
  failed "damage"
expect 0 "strip 1799 holds 4 flight lines, which lead back and forth, and is divided" check id7.las -output lines.json
check "pairs of lines" test "$(grep -c '"a":' lines.json)" = "$(grep -c '"a":' split.json)"
run calibrate id7.las -trajectory "$block/trajectory.csv" -output lines.json
check "calibrate divides them" grep -q '"1799.4"' lines.json
expect 0 "" icpatch id7.las -pair 1799.1:1799.2 -output lines.json
check "divided lines are aligned as the strips they were cut from" cmp \
  <(sed -n '/"centroid"/,$p' lines.json) <(sed -n '/"centroid"/,$p' pair.json)
expect 2 "no point is of strip 1799; there are 1799.1, 1799.2, 1799.3, 1799.4" icpatch id7.las \
  -pair 1799:1799.2 -output x.json
absent x.json
expect 0 "a strip holds several flight lines*unless strips are split into lines" intensity id7.las lines.las \
  -trajectory "$block/trajectory.csv"

training=(-training "$block/training.csv" -cell 1)
expect 0 "" classify "${strips[@]:0:2}" "${training[@]}" -output two.tif
expect 0 "the strip was not chosen" classify "${strips[@]}" "${training[@]}" -strips 1,2 -output some.tif \
  -checkpoints "$block/checkpoints.csv" -accuracy accuracy.json -classified classified
check "the map is that of the two strips" cmp two.tif some.tif
left_out accuracy.json 3 excluded
check "points that were excluded keep their class" cmp "${strips[3]}" classified/strip4.las
check "others are classified" sh -c "! cmp -s '${strips[0]}' classified/strip1.las"
expect 0 "" classify id0_*.las "${training[@]}" -split -without line3,line4 -output lines.tif
check "lines give the map of the strips they were cut from" cmp two.tif lines.tif

flight=(-trajectory "$good")
mkdir -p by_strip by_line
expect 0 "" intensity "${strips[@]:0:2}" "${flight[@]}" -corrected by_strip -output strips.json \
  -estimate strip_gains
expect 0 "" intensity id0_1.las id0_2.las "${flight[@]}" -split -corrected by_line -output lines.json \
  -estimate strip_gains
check "gains of lines are those of the strips they were cut from" test \
  "$(awk '/"strip_gains"/,/\]/' lines.json | sed 's/line//')" = "$(awk '/"strip_gains"/,/\]/' strips.json)"
for i in 1 2; do
  "$damage" "by_strip/strip$i.las" "same_$i.las" source_id 0 || failed damage
  check "so are intensities, $i" cmp "same_$i.las" "by_line/id0_$i.las"
done
expect 0 "the strip was not chosen" intensity id0_1.las id0_2.las "${flight[@]}" -split \
  -corrected by_line -output x.json -strips line1
left_out x.json line2 excluded
expect 0 "measured before the trajectory begins" intensity "${strips[0]}" out.las -trajectory late.csv \
  -keep_uncovered -output uncovered.json
left_out uncovered.json 1 before_trajectory
# Without surfaces, in columns.
expect 0 "measured before the trajectory begins" intensity "${strips[0]}" fast.las -trajectory late.csv \
  -keep_uncovered -no_incidence -no_fields
"$damage" "${strips[0]}" timeless.las some_times || failed damage
expect 0 "their GPS time is 0" intensity timeless.las out.las "${flight[@]}" -keep_uncovered -output x.json
left_out x.json 1 zero_time
expect 0 "" icpatch timeless.las "${strips[1]}" -strips 1,2 -output x.json
check "alignment needs no times" grep -q '"left_out": \[\]' x.json
mv timeless.las strip_1.las
expect 0 "their GPS time is 0" calibrate strip_1.las "${strips[@]:1}" "${flight[@]}" \
  -output calibration.json -estimate boresight_roll,boresight_pitch
left_out calibration.json 1 zero_time

# Four flights in one file without source ids.
"$damage" id0_1.las one.las append id0_2.las append id0_3.las append id0_4.las || failed damage
expect 0 "line4" info one.las -split -output info.json
columns 'NR > 1 { $1 += 90000 } 1' >elsewhere.csv
# Where a trajectory is given, every tool divides by it: here, the sensor hovers for 1.8 s.
columns '$1 > 401003.3 && $1 < 401005.1 { $2 = x; $3 = y } { x = $2; y = $3 } 1' >hover.csv
expect 0 "line5" info one.las -split -trajectory hover.csv -output info.json
left_out info.json hovering hovering
expect 0 "" check one.las -split -trajectory hover.csv -output q.json
left_out q.json hovering hovering
expect 0 "divided without the trajectory" info one.las -split -trajectory elsewhere.csv
expect 0 "" icpatch one.las -split -pair line1:line2 -output one.json
check "the file's lines are aligned as the strips they were cut from" cmp \
  <(sed -n '/"centroid"/,$p' one.json) <(sed -n '/"centroid"/,$p' pair.json)
expect 0 "" calibrate one.las -split "${flight[@]}" -output one.json \
  -estimate boresight_roll,boresight_pitch
check "line 1 and line 2 are a pair" grep -q '"a": "line1"' one.json
finish
