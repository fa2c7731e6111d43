#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# test_scanner_type.sh BIN_DIR SCRATCH_DIR DATA_DIR: a conical scanner whose trajectory has no attitude. Until 2026-11 arcs
# of a tenth of a second were taken for planes with pitch to 18 and crab to 54 degrees, exit status 0. Skipped (77) without
# the data.
data=${PCL_ALS_TEST_DATA:-$3}
source "$(dirname -- "${BASH_SOURCE[0]}")/tool_test.sh"
[[ -d $data/real/stbarth ]] || { echo "real test data is absent: $data"; exit 77; }

xz -dc "$data/real/stbarth/stbarth.las.xz" >stbarth.las
flight=(-trajectory "$data/real/stbarth/trajectory.csv")
expect 2 'no linear scanner' calibrate stbarth.las "${flight[@]}" -output c.json
expect 2 '-model nominal' calibrate stbarth.las "${flight[@]}" -output c.json
expect 2 'no linear scanner' apply stbarth.las out.las "${flight[@]}" -bias boresight_roll=100
absent out.las
# Nominal attitude uses the rigorous model; the result says so, and is applied with it.
run calibrate stbarth.las "${flight[@]}" -model nominal -output nominal.json
checks=$((checks + 1))
grep -q '"attitude": *"nominal"' nominal.json || failed "nominal.json does not say that the attitude is nominal"
# No bias differs from zero, so that the misfit may become slightly larger, which apply warns of.
run apply stbarth.las out.las "${flight[@]}" -calibration nominal.json -force
checks=$((checks + 1))
[[ $status == 0 && $(<out.txt) == *'nominal attitude'* ]] || failed "apply -force of nominal.json: status $status"
expect 0 'taken as level' apply stbarth.las forced.las "${flight[@]}" -bias boresight_roll=100 -force -no_record
expect 0 'nominal attitude' apply stbarth.las level.las "${flight[@]}" -bias boresight_roll=100 -model nominal -no_record
check "forced is nominal" cmp forced.las level.las
rm -f stbarth.las out.las forced.las level.las
finish
