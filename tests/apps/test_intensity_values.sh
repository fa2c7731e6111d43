#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# What pcl_als_intensity does to single values: gain control, pulse energy, zero and saturated intensity, 8 and 16 bits,
# points without time, above the sensor. Records are read with od, results worked out by hand.
source "$(dirname -- "$0")/tool_test.sh"

"$bin/pcl_als_simulate" -output block -preset small -scale 0.15 -density 0.1 -noise none -bias none -quiet || failed "simulate"
flight=(-trajectory block/trajectory.csv)
nothing=(-no_atmosphere -no_range -no_incidence -no_fields -no_original)  # all terms that are not under test

# Bytes of a record: at FILE INDEX POSITION. LAS header: start of the points at byte 96, record length at 105.
at() { echo $(($(od -An -tu4 -j96 -N4 "$1") + $2 * $(od -An -tu2 -j105 -N2 "$1") + $3)); }
intensity_of() { od -An -tu2 -j"$(at "$1" "$2" 12)" -N2 "$1" | tr -d ' '; }
float_of() { od -An -tf4 -j"$(at "$1" "$2" "$3")" -N4 "$1" | tr -d ' '; }
poke() { printf '%b' "$4" | dd of="$1" bs=1 seek="$(at "$1" "$2" "$3")" conv=notrunc status=none; }
divided() { awk -v i="$1" -v g="$2" 'BEGIN { printf "%d", i / g + 0.5 }'; }

# Gain control: the field range (float, behind the 30 bytes of format 6 and the true
# reflectance) serves as one. At 1000 the gain is 2, at 2000 4,
# linear between: 2 + 2 (r - 1000) / 1000; strip 1 is flown at 1150 m.
expect 0 '' intensity block/strip1.las base.las "${flight[@]}" -no_original
printf 'value,gain\n0,1\n1000,2\n2000,4\n' >steps.csv
expect 0 '' intensity base.las agc.las "${flight[@]}" "${nothing[@]}" -agc_field range -agc_gain steps.csv
for i in 0 100 500 1000; do
  range=$(float_of base.las $i 34)
  wanted=$(divided "$(intensity_of base.las $i)" "$(awk -v r="$range" 'BEGIN { print 2 + (r - 1000) / 500 }')")
  check "gain control of point $i: $(intensity_of agc.las $i), not $wanted" test "$(intensity_of agc.las $i)" = "$wanted"
done
printf 'value,gain\n0,1\n1000,2\n' >short.csv
expect 2 'lies outside the table' intensity base.las x.las "${flight[@]}" "${nothing[@]}" -agc_field range -agc_gain short.csv
expect 2 'it has reflectance range incidence_angle' intensity base.las x.las "${flight[@]}" -agc_field agc -agc_gain steps.csv

# Pulse energy at constant power: 50 and 200 kHz have the mean 100 kHz (geometric): twice and half the energy.
expect 0 '' intensity block/strip1.las block/strip3.las -corrected rates "${flight[@]}" "${nothing[@]}" \
  -pulse_rates 1=50000,3=200000
for i in 0 7 300; do
  check "energy of strip 1" test "$(intensity_of rates/strip1.las $i)" = "$(divided "$(intensity_of block/strip1.las $i)" 2)"
  check "energy of strip 3" test "$(intensity_of rates/strip3.las $i)" = $((2 * $(intensity_of block/strip3.las $i)))
done
expect 1 'strip 3 has none; give all or none' intensity block/strip1.las block/strip3.las -corrected rates "${flight[@]}" \
  -pulse_rates 1=50000

# Zero stays zero; 65535 is saturated in 16-bit data, 255 is not.
cp block/strip1.las values.las
poke values.las 0 12 '\x00\x00'
poke values.las 1 12 '\xff\xff'
poke values.las 2 12 '\xff\x00'
expect 0 'of intensity 0: 1 points; saturated (65535 and more): 1,' intensity values.las x.las "${flight[@]}"
check "zero stays zero" test "$(intensity_of x.las 0)" = 0
check "the original is kept" test "$(od -An -tu2 -j"$(at x.las 1 34)" -N2 x.las | tr -d ' ')" = 65535
expect 0 'beyond 65535 after correction: 1 points' intensity values.las x.las "${flight[@]}" "${nothing[@]}" -intensity_scale 2
check "beyond 65535" test "$(intensity_of x.las 1)" = 65535
check "scale" test "$(intensity_of x.las 2)" = 510
expect 3 '2 908 of 2 908 intensities are under 0.5 after correction' intensity values.las dark.las "${flight[@]}" "${nothing[@]}" -intensity_scale 1e-6
expect 2 'all intensities are zero' intensity dark.las x.las "${flight[@]}"

# 8-bit data: none is beyond 255, which is saturated then.
"$bin/pcl_als_simulate" -output eight -preset small -scale 0.15 -density 0.1 -noise none -gain 200 -quiet || failed "simulate 8 bits"
poke eight/strip1.las 5 12 '\xff\x00'
expect 0 'saturated (255 and more): 1,' intensity eight/strip1.las x.las "${flight[@]}"

# A point of 2000 km above the sensor: counted, left as it is; when most are, that is an error (test_intensity.sh).
cp block/strip1.las high.las
poke high.las 3 8 '\xff\xff\xff\x7f'
expect 0 '1 above the sensor' intensity high.las x.las "${flight[@]}"
check "above the sensor" test "$(intensity_of x.las 3)" = "$(intensity_of block/strip1.las 3)"
check "no range above the sensor" test "$(float_of x.las 3 36)" = nan

# No time at all (point format 0), and the time 0 of points that have none.
"$damage" block/strip1.las format0.las set point_format 0
expect 2 'point format 0 has no GPS time' intensity format0.las y.las "${flight[@]}"
"$damage" block/strip1.las zero.las zero_times
expect 2 'zero.las: *time' intensity zero.las y.las "${flight[@]}"
poke values.las 4 22 '\x00\x00\x00\x00\x00\x00\x00\x00'
# One point in a hundred may be without a trajectory; more only with -keep_uncovered.
expect 0 '1 points without a trajectory' intensity values.las x.las "${flight[@]}"
check "without a trajectory" test "$(intensity_of x.las 4)" = "$(intensity_of values.las 4)"

# Without surfaces points are computed in columns; a gain control of 1 everywhere makes the tool take them one by one, as
# with surfaces (its positions are floats there: 3e-8 of a range). Counts are the same, intensities to their rounding.
printf 'value,gain\n-1,1\n9,1\n' >ones.csv
poke values.las 3 8 '\xff\xff\xff\x7f'
singly=(-agc_field reflectance -agc_gain ones.csv)
counts_of() { grep -v 'Writing\|Looking\|Reading\|gain control' "$1"; }
points_of() { tail -c +$(($(od -An -tu4 -j96 -N4 "$1") + 1)) "$1"; }
compare() {  # WHAT OPTION…: both ways
  local what=$1 different
  shift
  expect 0 'points without a trajectory' intensity values.las singly.las "${flight[@]}" -keep_uncovered -no_fields -no_incidence "$@" "${singly[@]}"
  counts_of out.txt >singly.txt
  expect 0 'points without a trajectory' intensity values.las columns.las "${flight[@]}" -keep_uncovered -no_fields -no_incidence "$@"
  counts_of out.txt >columns.txt
  check "$what: counts" diff singly.txt columns.txt
  # The heads differ: one of them records gains.
  different=$(cmp -l <(points_of singly.las) <(points_of columns.las) | wc -l)
  check "$what: $different bytes differ" test "$different" -le 3
  expect 0 '' intensity values.las threads.las "${flight[@]}" -keep_uncovered -no_fields -no_incidence "$@" -threads 1
  check "$what: one thread as all" cmp threads.las columns.las
}
compare 'all terms'
compare 'no original' -no_original -intensity_scale 3
compare 'another exponent' -range_exponent 3.3 -attenuation 2 -strip_gains 1=0.7
compare 'no range' -no_range -visibility 1

absent y.las
finish
