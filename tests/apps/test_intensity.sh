#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# pcl_als_intensity as a user runs it: a block with gains and haze, reflectance of targets, and what it has to refuse.
source "$(dirname -- "$0")/tool_test.sh"

# A block whose strips were received with different gains, in haze; no biases.
"$bin/pcl_als_simulate" -output block -preset small -scale 0.3 -density 0.6 -noise range -bias none -seed 4 \
  -visibility 8 -strip_gains 1=1.2,2=0.9,3=0.8,4=1.1,5=1.05 -quiet || failed "simulate"
flight=(-trajectory block/trajectory.csv)
air=(-visibility 8 -temperature 29.8 -pressure 101.81 -humidity 0)

# value FILE FILTER: a number of a JSON, by its path.
value() {
  printf 'file(READ "%s" t)\nstring(JSON v GET "${t}" %s)\nmessage("${v}")\n' "$1" "$2" >value.cmake
  cmake -P value.cmake 2>&1
}

# Overlap-driven: gains against their geometric mean 0.99958, within 4 of their standard deviations.
expect 0 'strip_gains' intensity -h
expect 0 'Differences of strips' intensity block/strip*.las -corrected out "${flight[@]}" "${air[@]}" \
  -estimate strip_gains,incidence_exponent -report report -output result.json
strip=0
for gain in 1.2 0.9 0.8 1.1 1.05; do
  found=$(value result.json "strip_gains $strip value") std=$(value result.json "strip_gains $strip std")
  check "gain of strip $((strip + 1)): $found, true $gain" near "$found" "$(awk "BEGIN { print $gain / 0.999584 }")" \
    "$(awk "BEGIN { print 4 * $std * $gain }")"
  strip=$((strip + 1))
done
median() { value result.json "overlaps coefficient_of_variation $1 median"; }
check "strips differ before" awk "BEGIN { exit !($(median before) > 0.15) }"
check "strips agree after" awk "BEGIN { exit !($(median after) < 0.03) }"
for file in report.md slopes.csv classes.csv strips.csv histograms.csv; do
  check "report/$file" test -s report/$file
done
# Variance over mean of slopes of 5 to 10 degrees falls by far more than 30 %.
check "variance to mean" awk -F, '$1 == "5-10" { found = $9 < -30 } END { exit !found }' report/slopes.csv
expect 0 'strip1.las' info out/strip1.las

# The same parameters for one file, later; and the corrected file is recognised as such.
expect 0 '' intensity block/strip3.las one.las "${flight[@]}" -radiometry result.json
check "one file as all files" cmp one.las out/strip3.las
expect 0 '' intensity block/strip3.las one.las "${flight[@]}" -radiometry result.json -threads 1
check "one thread as all" cmp one.las out/strip3.las
expect 2 'was corrected before' intensity one.las two.las "${flight[@]}"
expect 1 'exclude each other' intensity block/strip3.las x.las "${flight[@]}" -radiometry result.json -estimate all
expect 2 'no result of pcl_als_intensity' intensity block/strip3.las x.las "${flight[@]}" -radiometry block/truth.json

# Targets give reflectance; none in reach: status 3 and the file all the same.
middle=$(awk -F, 'NR == 5 { print $1 "," $2 }' block/checkpoints.csv)
printf 'x,y,reflectance,id\n%s,0.3,tarp\n' "$middle" >targets.csv
expect 0 'a single target' intensity block/strip*.las -corrected out2 "${flight[@]}" "${air[@]}" -targets targets.csv \
  -target_radius 3 -output targets.json
check "the constant is written" awk "BEGIN { exit !($(value targets.json 'reflectance constant') > 1000) }"
run intensity block/strip1.las far.las "${flight[@]}" -targets <(printf 'x,y,reflectance\n0,0,0.5\n')
said=$(<err.txt)
check "no target in reach: status $status" test "$status" = 3 -a -s far.las
check "and says so in one line" test "$said" = "pcl_als_intensity: no reliable answer: no reference target was seen: intensities are relative"
# One strip has no overlaps to estimate from.
run intensity block/strip1.las lone.las "${flight[@]}" -estimate strip_gains,range_exponent -quiet
said=$(<err.txt)
check "no overlaps: status $status" test "$status" = 3 -a -s lone.las
check "and names what is missing: $said" \
  test "${said#pcl_als_intensity: no reliable answer: *(range_exponent, gain of strip}" != "$said"
expect 2 "line 2, column 'reflectance'" intensity block/strip1.las x.las "${flight[@]}" \
  -targets <(printf 'x,y,reflectance\n0,0,50\n')

# Terms, gains and scales on the command line.
expect 0 'atmosphere: not applied' intensity block/strip1.las plain.las "${flight[@]}" -no_atmosphere -no_range -no_incidence \
  -no_original -no_fields
check "without terms nothing changes" cmp plain.las block/strip1.las
expect 3 "beyond 65535" intensity block/strip3.las x.las "${flight[@]}" -intensity_scale 1000
expect 3 "under 0.5" intensity block/strip3.las x.las "${flight[@]}" -intensity_scale 0.0001
expect 1 'there is no strip 9' intensity block/strip3.las x.las "${flight[@]}" -pulse_rates 3=50000,9=50000
expect 0 '' intensity block/strip3.las x.las "${flight[@]}" -strip_gains 3=0.8 -attenuation 0.5
expect 1 'no strip 9' intensity block/strip3.las x.las "${flight[@]}" -strip_gains 9=0.8
rm -f x.las

# 8-bit data: 255 is saturated; zeros stay zero.
"$bin/pcl_als_simulate" -output small -preset small -scale 0.2 -density 0.3 -gain 100 -quiet || failed "simulate 8 bit"
expect 0 'saturated' intensity small/strip3.las eight.las -trajectory small/trajectory.csv -saturation 150
expect 0 '' intensity small/strip3.las eight.las -trajectory small/trajectory.csv -intensity_scale 100

# PCD: one point 500 m below the sensor: 400 (500/1000)^2 = 100; its fields behind the others. No surface: NaN.
printf 'time,x,y,z\n0,0,0,500\n5,250,0,500\n10,500,0,500\n' >line.csv
printf '%s\n' 'VERSION 0.7' 'FIELDS x y z intensity gps_time' 'SIZE 4 4 4 4 8' 'TYPE F F F F F' 'COUNT 1 1 1 1 1' 'WIDTH 1' \
  'HEIGHT 1' 'VIEWPOINT 0 0 0 1 0 0 0' 'POINTS 1' 'DATA ascii' '250 0 0 400 5' >point.pcd
expect 0 '1 without a surface' intensity point.pcd corrected.pcd -trajectory line.csv -no_atmosphere
floats() { tail -c 47 corrected.pcd | od -An -tf4 -j"$1" -N4 | tr -d ' '; }
check "PCD: intensity $(floats 20)" test "$(floats 20)" = 100
check "PCD: original intensity $(floats 35)" test "$(floats 35)" = 400
check "PCD: range $(floats 39)" test "$(floats 39)" = 500
check "PCD: no incidence $(floats 43)" test "$(floats 43)" = nan

# What it refuses, in one line, leaving nothing.
expect 1 'option -trajectory is needed' intensity block/strip1.las x.las
expect 1 "option -visibility: '0' is not a number from 0.01 to 500 km" intensity block/strip1.las x.las "${flight[@]}" -visibility 0
expect 1 'option -humidity' intensity block/strip1.las x.las "${flight[@]}" -humidity 120
expect 1 'option -attenuation' intensity block/strip1.las x.las "${flight[@]}" -attenuation -1
expect 1 'option -range_exponent' intensity block/strip1.las x.las "${flight[@]}" -range_exponent -2
expect 1 "'gains' is none of" intensity block/strip1.las x.las "${flight[@]}" -estimate gains
expect 1 'is also an input' intensity block/strip1.las block/strip1.las "${flight[@]}"
expect 1 'of one kind' intensity block/strip1.las x.pcd "${flight[@]}"
expect 1 'option -agc_field needs -agc_gain' intensity block/strip1.las x.las "${flight[@]}" -agc_field agc
expect 2 'has no extra field agc' intensity block/strip1.las x.las "${flight[@]}" -agc_field agc \
  -agc_gain <(printf 'value,gain\n0,1\n255,2\n')
expect 2 'lies outside the table' intensity block/strip1.las x.las "${flight[@]}" -agc_field reflectance \
  -agc_gain <(printf 'value,gain\n5,1\n6,2\n')
expect 2 'nothing.las' intensity nothing.las x.las "${flight[@]}"
sed 's/^\([0-9.]*\),\([^,]*\),\([^,]*\),[^,]*/\1,\2,\3,500/' block/trajectory.csv >low.csv
expect 2 'lie above the trajectory' intensity block/strip1.las x.las -trajectory low.csv
awk -F, 'NR == 1 || $1 < 401253' block/trajectory.csv >short.csv
expect 2 '-keep_uncovered leaves them' intensity block/strip2.las x.las -trajectory short.csv
absent x.las x.pcd
expect 0 'points without a trajectory' intensity block/strip2.las x.las -trajectory short.csv -keep_uncovered
rm x.las
absent x.las x.pcd
finish
