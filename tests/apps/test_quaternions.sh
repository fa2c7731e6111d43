#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# Attitudes as quaternions, of both conventions: the results are those of roll, pitch and heading.
source "$(dirname -- "$0")/tool_test.sh"

csv=$block/trajectory.csv
# quaternions NAME HEADER PROGRAM: of the turns by z, y, x (degrees) that PROGRAM sets from $5, $6, $7 (roll, pitch,
# heading).
quaternions() {
  awk -F, -v header="$2" 'function c(t) { return cos(t * atan2(0, -1) / 360) }
    function s(t) { return sin(t * atan2(0, -1) / 360) }
    NR == 1 { print header; next }
    { '"$3"'
      w = c(x) * c(y) * c(z) + s(x) * s(y) * s(z); i = s(x) * c(y) * c(z) - c(x) * s(y) * s(z)
      j = c(x) * s(y) * c(z) + s(x) * c(y) * s(z); k = c(x) * c(y) * s(z) - s(x) * s(y) * c(z)
      printf "%s %s %s %s %.15f %.15f %.15f %.15f\n", $1, $2, $3, $4, i, j, k, w }' "$csv" >"$1"
}
quaternions ned.txt 'timestamp tx ty tz qx qy qz qw' 'x = $5; y = $6; z = $7'
quaternions enu.txt '# time x y z Quat_X Quat_Y Quat_Z Quat_W' 'x = $5; y = -$6; z = 90 - $7'

apply=(apply "$block/strip1.las" out.las -bias boresight_roll=100,boresight_pitch=80)
calibrate=(calibrate "$block"/strip?.las -control "$block/control.csv" -model rigorous -output c.json)
expect 0 '' "${apply[@]}" -trajectory "$csv"
mv out.las plain.las
expect 0 '' "${calibrate[@]}" -trajectory "$csv"
grep '"bias"' c.json >plain.txt
expect 0 'heading within 2 degrees of the course' info -trajectory "$csv" -output plain.json
equal() {  # FILE: the biases are those of the angles, to the rounding of the quaternions
  paste -d' ' <(grep -o '"bias": *[-0-9.e]*' "$1" | sed 's/.*: *//') \
    <(grep -o '"bias": *[-0-9.e]*' plain.txt | sed 's/.*: *//') |
    awk '{ n++; d = $1 - $2; if (d < 0) d = -d; a = $2 < 0 ? -$2 : $2; if (d > 1e-4 * a + 1e-5) bad = 1 }
      END { exit n < 8 || bad }'
}
facts() { grep -E 'deg"|follow|attitude"' "$1" | tr -d ,; }
for file in ned enu; do
  axes='to north, east, down, as the course shows'
  [[ $file == ned ]] || axes='to east, north, up, as the course shows'
  rm -f out.las
  expect 0 "$axes" "${apply[@]}" -trajectory $file.txt
  check "points with $file.txt" cmp out.las plain.las
  expect 0 "$axes" "${calibrate[@]}" -trajectory $file.txt
  check "the calibration with $file.txt" equal c.json
  expect 0 "heading within 2 degrees of the course; quaternions turn" info -trajectory $file.txt -output $file.json
  check "facts of $file.txt" diff <(facts plain.json) <(facts $file.json)
  # What is stated is taken, right or wrong.
  rm -f out.las
  expect 0 '' "${apply[@]}" -trajectory $file.txt -trajectory_axes $file
  check "stated axes of $file.txt" cmp out.las plain.las
done
expect 2 'does not follow its course' "${apply[@]}" -trajectory ned.txt -trajectory_axes enu
expect 2 'does not follow its course' "${apply[@]}" -trajectory enu.txt -trajectory_axes ned

# A sensor that is turned to the side: the course tells neither.
quaternions side.txt 'timestamp tx ty tz qx qy qz qw' 'x = $5; y = $6; z = $7 + 90'
for tool in "apply $block/strip1.las out.las -bias boresight_roll=100" "calibrate $block/strip1.las $block/strip2.las -output x.json" \
  "trajectory -output x.csv"; do
  # shellcheck disable=SC2086
  expect 2 'side.txt: the course does not show whether its quaternions * state them with -trajectory_axes' $tool -trajectory side.txt
done
absent x.json x.csv
expect 0 'the course does not show whether its quaternions' info -trajectory side.txt
rm -f out.las
expect 0 '' "${apply[@]}" -trajectory side.txt -model nominal

awk 'NR == 4 { $5 = $6 = $7 = $8 = 0 } { print }' ned.txt >zero.txt
expect 2 'zero.txt: line 4: the norm of its quaternion is 0, not 1' "${apply[@]}" -trajectory zero.txt
finish
