#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# test_prior.sh BIN_DIR SCRATCH_DIR: what earlier flights tell, given to a calibration, and whether a calibration
# holds for other strips.
source "${BASH_SOURCE[0]%/*}/tool_test.sh"

bias=lever_arm_x=0.05,lever_arm_y=-0.05,boresight_pitch=-30,boresight_heading=40,range_bias=0.12,scan_angle_scale=1e-4
for name in full now moved; do
  roll=-90
  [[ $name == moved ]] && roll=-30
  run simulate -output $name -preset small -density 0.5 -noise realistic -seed "$([[ $name == full ]] && echo 1 || echo 2)" \
    -bias "$bias,boresight_roll=$roll"
  [[ $status == 0 ]] || failed "simulate $name"
done
full=(full/strip*.las -trajectory full/trajectory.csv)
now=(now/strip1.las now/strip2.las -trajectory now/trajectory.csv)
expect 0 "usable" calibrate "${full[@]}" -control full/control.csv -output full.json

# The prior of a file: its shares, its record, the inputs.
expect 0 "from prior" calibrate "${now[@]}" -prior full.json -output now.json -report now_report
check "now.json: the share of the prior" grep -q '"prior_share"' now.json
check "now.json: the prior" grep -q '"source": "full.json"' now.json
check "now.json: lever_arm_x is estimated" awk '/"lever_arm_x": \{/ { arm = 1 }
  arm && /"status": "estimated"/ { found = 1; exit } arm && /\}/ { exit } END { exit !found }' now.json
check "now.json: full.json is an input" bash -c "sed -n '/\"inputs\"/,/\]/p' now.json | grep -q full.json"
check "the report states the shares" grep -q 'from prior' now_report/parameters.csv
expect 0 "usable" calibrate "${now[@]}" -prior full.json -prior_change boresight_roll=0.5,boresight_pitch=0.5 -output close.json

# A history has the same form.
awk '/"format"/ { print " \"format\": \"pcl_als history\","; next } /^ "version"/ { print " \"version\": 1,"; next }
  /"instrument"/ { print " \"change_std\": {\"boresight_roll\": 3, \"lever_arm_x\": 0.002}," } { print }' full.json >history.json
expect 0 "the prior of history.json" calibrate "${now[@]}" -prior history.json -output history_now.json

# The roll has changed by 60 arc-seconds.
expect 0 "boresight_roll: the prior of full.json says" calibrate moved/strip*.las -trajectory moved/trajectory.csv \
  -prior full.json -output moved.json
check "moved.json: the prior of the roll is released" grep -q '"released": true' moved.json

# The strips that the prior is from.
expect 0 "observations count twice" calibrate "${full[@]}" -prior full.json -output twice.json

# Values in the command, as before.
expect 0 "from prior" calibrate "${now[@]}" -prior boresight_roll=-90:5,lever_arm_x=0.05:0.01 -output text.json

# What is wrong is said in one line.
wrong=(-output wrong.json)
expect 2 "absent.json" calibrate "${now[@]}" "${wrong[@]}" -prior absent.json
expect 2 "give a calibration.json or a history.json" calibrate "${now[@]}" "${wrong[@]}" -prior now/truth.json
expect 1 "no such parameter" calibrate "${now[@]}" "${wrong[@]}" -prior roll=0:5
expect 1 "option -prior_change: -prior gives values" calibrate "${now[@]}" "${wrong[@]}" -prior boresight_roll=0:5 \
  -prior_change boresight_roll=3
expect 1 "must not be negative" calibrate "${now[@]}" "${wrong[@]}" -prior full.json -prior_change boresight_roll=-3
expect 1 "is also an input (-prior)" calibrate "${now[@]}" -prior full.json -output full.json
sed 's/"status": "usable"/"status": "no_improvement"/' full.json >useless.json
expect 2 "should not be used as a prior" calibrate "${now[@]}" "${wrong[@]}" -prior useless.json
absent wrong.json

# Whether a calibration holds.
flight=(-trajectory now/trajectory.csv -calibration full.json)
holds="the calibration full.json holds for these strips: misfit"
expect 0 "$holds" apply now/strip*.las -corrected checked "${flight[@]}" -check yes
# A combination of flights is checked by itself; the calibration of the flight is not.
expect 0 "History of 1 calibration" history full.json -output combined.json
combined=(-trajectory now/trajectory.csv -calibration combined.json)
expect 0 "${holds/full/combined}" apply now/strip*.las -corrected by_itself "${combined[@]}"
expect 0 "" apply full/strip*.las -corrected full_corrected -trajectory full/trajectory.csv -calibration full.json
check "no check without need" bash -c '! grep -q "holds for" out.txt err.txt'
expect 0 "" apply now/strip*.las -corrected unchecked "${combined[@]}" -check no
check "no check where it is not wanted" bash -c '! grep -q "holds for" out.txt err.txt'
check "a check changes no point" cmp by_itself/strip1.las unchecked/strip1.las
expect 0 "was not checked" apply now/strip1.las one.las "${flight[@]}" -check yes
expect 1 "check" apply now/strip1.las one.las "${flight[@]}" -check yes -invert
expect 3 "combined.json does not hold for these strips: *boresight_roll differs by" apply moved/strip*.las \
  -corrected moved_corrected -trajectory moved/trajectory.csv -calibration combined.json
check "all strips are written" test -s moved_corrected/strip5.las
finish
