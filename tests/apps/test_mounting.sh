#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# pcl_als_mounting: wrong options, values computed by hand, its file, systems and verdicts, and a
# simulated block that was computed with a wrong mounting.
source "$(dirname -- "$0")/tool_test.sh"

# parameters ROLL HEADING RANGE SCALE: biases in arcsec, m and 1; the others are zero.
parameters() {
  local name unit bias
  for name in lever_arm_x lever_arm_y lever_arm_z boresight_pitch boresight_roll \
    boresight_heading range_bias scan_angle_scale; do
    unit=m bias=0
    [[ $name == boresight* ]] && unit=arcsec
    [[ $name == scan* ]] && unit=1 bias=$4
    [[ $name == boresight_roll ]] && bias=$1
    [[ $name == boresight_heading ]] && bias=$2
    [[ $name == range* ]] && bias=$3
    printf '%s"%s": {"bias": %s, "std": %s, "unit": "%s", "status": "estimated"}' \
      "${comma:-}" "$name" "$bias" "$([[ $unit == arcsec ]] && echo 2 || echo 0.01)" "$unit"
    local comma=,
  done
}
calibration() {  # FILE ROLL HEADING RANGE SCALE [VERDICT]
  printf '{"format": "pcl_als calibration", "version": 1, "model": "rigorous", "attitude": "trajectory",
  "verdict": {"status": "%s", "reason": "made by hand"}, "parameters": {%s}}\n' \
    "${6:-usable}" "$(parameters "${@:2:4}")" >"$1"
}
calibration hand.json 100 0 0.05 0.0001
m=(-calibration hand.json -convention zyx_frd)

# Options.
expect 1 "one of the options -convention and -order is needed" mounting
expect 1 "option -calibration is needed" mounting -convention zyx_frd -angles 0,0,0
expect 1 "option -angles is needed" mounting "${m[@]}"
expect 1 "option -angles: '1,2' is not three numbers" mounting "${m[@]}" -angles 1,2
expect 1 "option -angles: '1,2,x' is not three numbers" mounting "${m[@]}" -angles 1,2,x
expect 1 "option -lever_arm: 'nan,0,0' is not three numbers" mounting "${m[@]}" -angles 1,2,3 -lever_arm nan,0,0
expect 1 "exclude each other" mounting "${m[@]}" -order ZYX -angles 1,2,3
expect 1 "option -convention" mounting -calibration hand.json -convention riegel -angles 1,2,3
expect 1 "option -order: 'ZZX' is no order" mounting -calibration hand.json -order ZZX -angles 1,2,3
expect 1 "option -axes: 'frl' are no axes" mounting "${m[@]}" -angles 1,2,3 -axes frl
expect 1 "option -signs: '1,2,1' is not three of 1 and -1" mounting "${m[@]}" -angles 1,2,3 -signs 1,2,1
expect 1 "option -unit" mounting "${m[@]}" -angles 1,2,3 -unit mil
expect 1 "no system 'left'; it has one without a name" mounting "${m[@]}" -angles 1,2,3 -system left
expect 1 "output" mounting "${m[@]}" -angles 1,2,3 -output hand.json
expect 1 "output" mounting "${m[@]}" -angles 1,2,3 -output mounting.csv
expect 2 "none.json" mounting -calibration none.json -convention zyx_frd -angles 0,0,0

# The list needs nothing else, and names the sources.
expect 0 "novatel: *Rz(Z) Rx(X) Ry(Y)*source: docs.novatel.com" mounting -convention list
check "seven conventions" test "$("$bin/pcl_als_mounting" -convention list | grep -c '^    source: ')" = 7

value() {  # NAME: the new value and its standard deviation in the table
  awk -F'|' -v name="$1" '{ gsub(/ /, "", $2) } $2 == name { print $4 + 0, $5 + 0 }' out.txt
}
equal() {  # WHAT TEXT WANTED
  checks=$((checks + 1))
  [[ $2 == "$3" ]] || failed "$1: '$2', not '$3'"
}

has() {  # WHAT TEXT: the last output has it (a glob pattern)
  checks=$((checks + 1))
  [[ $(<out.txt) == *$2* ]] || failed "$1: the output lacks '$2'"
}

# A roll that is assumed too large by 100 arcsec (0.0277778 degrees), straight and turned by 90
# degrees, where it is the pitch; ranges that are too long, scan angles that are too large.
run mounting "${m[@]}" -angles 1,0,0 -lever_arm 0,0,0
equal "roll, straight" "$(value roll)" "0.972222 0.0005556"
equal "pitch, straight" "$(value pitch)" "0 0.0005556"
has "ranges" "ranges are 0.0500 m too long; add -0.0500 m to every range"
run mounting "${m[@]}" -angles 0,0,90 -lever_arm 0,0,0 -output mounting.json
equal "roll, turned" "$(value roll)" "0 0.0005556"
equal "pitch, turned" "$(value pitch)" "0.0277778 0.0005556"
equal "yaw, turned" "$(value yaw)" "90 0.0005556"
has "scan angles" "too large; multiply every scan angle (or its scale) by 0.99990001"
has "the error of a subtraction" "wrong by 141.42 arcsec, up to 685.6 mm at 1000 m"
expect 0 "up to 68.6 mm at 100 m" mounting "${m[@]}" -angles 0,0,90 -range 100
check "format" grep -q '"format": "pcl_als mounting"' mounting.json
check "covariance" grep -q '"covariance"' mounting.json
check "lever arm, by hand" grep -q '"lever_arm_m"' mounting.json

# The same mounting in other words: order, fixed axes, gon, the inverse, another sign. In left-handed
# axes forward, right, up, raising the right side is a positive turn about x, which is the axis of
# the pitch after a yaw of -90 degrees.
run mounting -calibration hand.json -order ZYX -angles 90,0,0
equal "order" "$(value Y)" "0.0277778 0.0005556"
run mounting -calibration hand.json -order XYZ -about fixed -angles 0,0,100 -unit gon
equal "fixed axes, gon" "$(value Y)" "0.0308642 0.0006173"
run mounting -calibration hand.json -order XYZ -angles 0,0,-90 -direction body_to_scanner
equal "body to scanner" "$(value Y)" "-0.0277778 0.0005556"
run mounting "${m[@]}" -angles 0,0,90 -signs 1,-1,1
equal "sign of the pitch" "$(value pitch)" "-0.0277778 0.0005556"
run mounting "${m[@]}" -angles 0,0,-90 -axes fru
equal "left-handed axes" "$(value pitch)" "0.0277778 0.0005556"

# What is not as usual is said.
run mounting -calibration hand.json -order ZYX -angles 0,89.99,0 -axes flu
has "near gimbal lock" "note: near gimbal lock"
run mounting "${m[@]}" -angles 0,0,0
has "no lever arm" "old lever arm was not given: *, by 0.48 mm per metre"
calibration lost.json 100 0 0 0 not_converged
expect 2 "lost.json: this calibration should not be applied, not converged: made by hand; -force" \
  mounting -calibration lost.json -convention zyx_frd -angles 0,0,0 -output lost_mounting.json
absent lost_mounting.json
run mounting -calibration lost.json -convention zyx_frd -angles 0,0,0 -force
equal "-force" "$status $(value roll)" "0 -0.0277778 0.0005556"
equal "-force warns" "$(<err.txt)" "pcl_als_mounting: warning: lost.json: not converged: made by hand"

# A block whose points were computed with wrong angles and lever arm: the true ones are zero, those
# in use the biases (arcsec of the convention pcl_als).
bias=boresight_pitch=60,boresight_roll=-90,boresight_heading=40,lever_arm_x=0.1
check "simulating the block" "$bin/pcl_als_simulate" -output block -preset small -noise range -seed 3 \
  -bias "none,$bias" -quiet
check "calibrating the block" "$bin/pcl_als_calibrate" block/strip{1,2,3,4,5}.las -quiet \
  -trajectory block/trajectory.csv -control block/control.csv -output calibration.json \
  -estimate boresight_pitch,boresight_roll,boresight_heading,lever_arm_x
expect 0 "New mounting" mounting -calibration calibration.json -convention pcl_als -angles 60,-90,40 \
  -lever_arm 0.1,0,0
within() {  # NAME LIMIT: the new value is zero to within four standard deviations and the limit
  checks=$((checks + 1))
  awk -v limit="$2" '{ v = $1 < 0 ? -$1 : $1; exit !(v <= 4 * $2 && v < limit && $2 > 0) }' <<<"$(value "$1")" ||
    failed "$1 is not zero: $(value "$1")"
}
within pitch 10
within roll 5
within heading 20
within leverarmx 0.05
finish
