#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# test_fixed_information.sh BIN_DIR SCRATCH_DIR: strips that are held fixed, and reference surfaces. The block has a range
# bias, which strips alone do not show; the earlier delivery is the same flight without biases.
source "$(dirname -- "${BASH_SOURCE[0]}")/tool_test.sh"

simulation=(-preset small -scale 0.6 -density 0.5 -noise range)
run simulate -output new "${simulation[@]}" -bias range_bias=0.2,boresight_roll=60
run simulate -output earlier "${simulation[@]}" -bias none
[[ $status == 0 ]] || failed "simulate"
cp earlier/strip3.las new/strip3.las
strips=(new/strip1.las new/strip2.las new/strip3.las new/strip4.las)
flight=(-trajectory new/trajectory.csv)
calibrate=(calibrate "${strips[@]}" "${flight[@]}" -candidates 10)

range_of() {  # FILE: the range bias, 0 where it is not estimated
  awk '/"range_bias": *{/ { getline; gsub(/[^-0-9.e]/, "", $2); print $2; exit }' "$1"
}

# Fixed strips: the range bias is found (3 cm: the trajectory counts as certain to 2 cm), they are recorded, and apply
# leaves them as they are.
expect 0 "Strips 3 were held fixed" "${calibrate[@]}" -fixed 3 -output fixed.json -corrected corrected -report report
check "range bias $(range_of fixed.json)" near "$(range_of fixed.json)" 0.2 0.03
check "fixed strips are no control points" grep -q ", 1 fixed strip, " fixed.json
check "the page names them" grep -q "fixed strips" report/report.md
check "the fixed strip is unchanged" cmp new/strip3.las corrected/strip3.las
expect 0 "unchanged, because held fixed: strips 3" apply new/strip3.las applied.las "${flight[@]}" -calibration fixed.json
check "apply leaves it unchanged" cmp new/strip3.las applied.las
expect 0 "" apply new/strip2.las applied2.las "${flight[@]}" -calibration fixed.json
check "apply corrects others" cmp applied2.las corrected/strip2.las
expect 2 "was held fixed" apply new/strip3.las none.las "${flight[@]}" -calibration fixed.json -uncertainty
expect 1 "there is no strip 9" "${calibrate[@]}" -fixed 9 -output no.json
absent none.las no.json

# A reference surface of points.
expect 0 "| strip2.las           |" calibrate new/strip1.las new/strip2.las "${flight[@]}" -candidates 10 \
  -reference earlier/strip2.las:0.03 -output points.json
check "range bias $(range_of points.json)" near "$(range_of points.json)" 0.2 0.03
check "a surface is no control point" grep -q ", 1 reference surface, " points.json
check "a COPC file of the surface" "$bin/las_to_copc" earlier/strip2.las earlier/strip2.copc.laz
expect 0 "strip2.copc.laz" calibrate new/strip1.las new/strip2.las "${flight[@]}" -candidates 10 \
  -reference earlier/strip2.copc.laz:0.03 -output copc.json
check "a COPC surface gives the same range bias" near "$(range_of copc.json)" "$(range_of points.json)" 0.001
check "the result lists the file" grep -q '"earlier/strip2.las"' points.json
run convert earlier/strip2.las elsewhere.las -bounds 0,0,1,1
expect 2 "no.las" "${calibrate[@]}" -reference no.las -output no.json
expect 1 "standard deviation must be positive" "${calibrate[@]}" -reference earlier/strip2.las:0 -output no.json
absent no.json

# The same range bias with a selection of pairs, with the channel of the scanner as a strip, and for two systems; both
# kinds are unaffected by these options. Tolerance as above.
together=(-select 5 / -channels scanner_channel / -systems a=1,2 b=4 -own range_bias)
options=()
for word in "${together[@]}" /; do
  [[ $word == / ]] || { options+=("$word"); continue; }
  expect 0 "" "${calibrate[@]}" -fixed 3 "${options[@]}" -output together.json
  check "fixed ${options[*]}: $(range_of together.json)" near "$(range_of together.json)" 0.2 0.03
  expect 0 "" calibrate new/strip1.las new/strip2.las new/strip4.las "${flight[@]}" -candidates 10 \
    -reference earlier/strip2.las:0.03 "${options[@]}" -output together.json
  check "reference ${options[*]}: $(range_of together.json)" near "$(range_of together.json)" 0.2 0.03
  options=()
done

# Targets: the tool lists their places in plan, and refuses diameters that cannot be.
run simulate -output targets -preset small -scale 0.6 -density 2 -noise range -target_count 6 -target_diameter 3
[[ $status == 0 ]] || failed "simulate targets"
check "truth.json has the targets" grep -q '"diameter_m": 3.0' targets/truth.json
awk -F, 'NR == 1 || $5 != ""' targets/control.csv >targets_only.csv
expect 0 "Targets in the strips to the east and north" calibrate targets/strip?.las -trajectory targets/trajectory.csv \
  -control targets_only.csv -candidates 10 -output targets.json
check "east and north are components" test "$(grep -c '"component": "\(east\|north\)"' targets.json)" -ge 8
check "the range bias is determined by targets" near "$(range_of targets.json)" 0.12 0.04
check "targets are named as such" grep -q "[56] targets" targets.json
sed '2s/,3.000$/,0.01/' targets_only.csv >narrow.csv
expect 2 "column 'diameter'*must be 0.1 to 20 m" calibrate targets/strip?.las -trajectory targets/trajectory.csv \
  -control narrow.csv -output no.json
absent no.json

# References and control that lie elsewhere: what no file states, the coordinates show.
run simulate -output away -preset small -scale 0.6 -density 0.1 -noise none -origin 700000,5560000,1000
expect 2 "km beside the strips" "${calibrate[@]}" -reference away/strip2.las -output no.json
awk -F, 'NR == 1 { print; next } { print $1 "," $3 "," $2 "," $4 }' new/control.csv > exchanged.csv
expect 2 "would lie within them with x and y exchanged" "${calibrate[@]}" -control exchanged.csv -output no.json
absent no.json
expect 0 "calibrated without them; they lie" "${calibrate[@]}" -control exchanged.csv -force -output forced.json
finish
