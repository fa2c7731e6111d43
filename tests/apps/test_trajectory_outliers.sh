#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# Single samples of a trajectory that are wrong: every tool names and leaves them out, and results are those of the
# intact trajectory. Until 2026-11 one sample of zeros moved 76 points of this block by up to 2.4 km, with status 0.
source "$(dirname -- "$0")/tool_test.sh"

csv=$block/trajectory.csv
biases=(-bias boresight_roll=100,boresight_pitch=100,boresight_heading=60,lever_arm_x=0.1)

# variant NAME FIRST LAST PROGRAM: the trajectory, its lines FIRST to LAST changed by an awk program.
variant() {
  awk -F, -v OFS=, -v OFMT=%.9f -v CONVFMT=%.9f "NR >= $2 && NR <= $3 { $4 } { print }" "$csv" >"$1.csv"
}
zeros='for (i = 2; i <= 7; ++i) $i = 0'

# moved FILE: the largest difference of a coordinate of its points to those of clean.las, in units of the file.
moved() {
  perl -e 'for (@ARGV) { open my $f, "<:raw", $_; local $/; my $d = <$f>;
      my ($at, $length, $n) = (unpack("x96V", $d), unpack("x105v", $d), unpack("x247Q<", $d));
      push @a, [map { unpack "l<3", substr($d, $at + $_ * $length, 12) } 0 .. $n - 1] }
    $m = 0; for (0 .. $#{$a[0]}) { $x = abs($a[0][$_] - $a[1][$_]); $m = $x if $x > $m } print $m' clean.las "$1"
}

expect 0 '' apply "$block/strip1.las" clean.las -trajectory "$csv" "${biases[@]}"
check "an intact trajectory has no outliers" test "$(grep -c contradict out.txt)" = 0
# Lines 701 to 1151 are of the first strip.
variant zero 701 701 "$zeros"
variant heading 701 701 '$7 = ($7 + 90) % 360'
variant late 701 701 '$1 += 3'
variant whole 701 701 "\$1 = 0; $zeros"
variant two 701 702 "$zeros"
variant ten 701 710 "$zeros"
while read -r wrong text; do
  expect 0 "$text" apply "$block/strip1.las" $wrong.las -trajectory $wrong.csv "${biases[@]}"
  check "$wrong: points are those of the intact trajectory" test "$(moved $wrong.las)" -le 2
done <<'CASES'
zero 1 of 8 255 samples contradicts its neighbours and is excluded: line 701 (
heading line 701 (401003.495 s): attitude differs by 90.0 degrees
late line 701 (
whole alone between gaps excluded
two 2 of 8 255 samples contradict their neighbours and are excluded: line 701 to line 702
ten line 701 to line 710
CASES
# The first and the last sample.
variant ends 2 2 '$2 += 1e5'
awk -F, -v OFS=, 'NR == 8256 { $3 = 0 } { print }' ends.csv >both.csv
expect 0 'excluded: line 2 (401000.000 s): 100 km beside the path, line 8256 (' \
  apply "$block/strip1.las" ends.las -trajectory both.csv "${biases[@]}"

# More than can be bridged is refused by line; nothing is written.
variant many 701 800 "$zeros"
for tool in "apply $block/strip1.las out.las ${biases[*]}" "intensity $block/strip1.las out.las" \
  "check $block/strip1.las $block/strip2.las -output q.json" "trajectory -output out.csv" \
  "calibrate $block/strip1.las $block/strip2.las -output c.json"; do
  # shellcheck disable=SC2086
  expect 2 'many.csv: 100 of 8 255 samples contradict those before and behind them, *line 701 to line 800' \
    $tool -trajectory many.csv
done
absent out.las out.csv q.json c.json

# Every tool names the line; so do several files, of which one has the outlier.
expect 0 'line 701' check "$block/strip1.las" "$block/strip2.las" -output q.json -trajectory zero.csv
expect 0 'line 701' intensity "$block/strip1.las" i.las -trajectory zero.csv
expect 0 'line 701' trajectory -trajectory zero.csv -output t.csv
check "the converted trajectory lacks the sample" test "$(grep -vc '^#' t.csv)" = 8255
check "info names the line" grep -q 'line 701' <("$bin/pcl_als_info" -trajectory zero.csv)
expect 0 '' info -trajectory zero.csv -output zero.json
check "info writes the line" grep -q '"line": 701' zero.json
expect 0 'not usable: 100 of 8 255' info -trajectory many.csv
mkdir parts
head -n 3000 zero.csv >parts/a.csv
{ head -n 1 zero.csv; tail -n +3001 zero.csv; } >parts/b.csv
expect 0 'a.csv: 1 of 2 999 samples contradicts its neighbours and is excluded: line 701' \
  apply "$block/strip1.las" parts.las -trajectory parts "${biases[@]}"
check "two files: points are those of the intact trajectory" test "$(moved parts.las)" -le 2

# A calibration is that of the intact trajectory, but for one sample less.
calibrate=(calibrate "$block"/strip*.las -control "$block/control.csv")
pitch() { grep -A 3 '"boresight_pitch"' "$1" | awk -F'[:,]' '/"bias"/ { print $2; exit }'; }
expect 0 '' "${calibrate[@]}" -trajectory "$csv" -output clean.json
for wrong in zero heading; do
  expect 0 'line 701' "${calibrate[@]}" -trajectory $wrong.csv -output $wrong.json
  check "$wrong: pitch $(pitch $wrong.json)" awk -v a="$(pitch clean.json)" -v b="$(pitch $wrong.json)" \
    'BEGIN { exit !(a != "" && (a - b) ^ 2 < 0.01) }'
done

# One latitude of an SBET, by 0.01 degrees.
if "$bin/pcl_als_trajectory" -trajectory "$csv" -crs EPSG:32611 -output flight.sbet >out.txt 2>err.txt; then
  perl -e 'open my $f, "+<:raw", "flight.sbet"; seek $f, 699 * 136 + 8, 0; read $f, my $d, 8;
    seek $f, 699 * 136 + 8, 0; print $f pack("d<", unpack("d<", $d) + 1.745e-4)'
  expect 0 'record 700 (401003.495 s): 1112 m beside the path' \
    apply "$block/strip1.las" sbet.las -trajectory flight.sbet "${biases[@]}"
  check "SBET: points are those of the intact trajectory" test "$(moved sbet.las)" -le 2
fi

finish
