#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# test_undetermined.sh BIN_DIR SCRATCH_DIR: estimates that tell nothing are named. Two opposite strips determine the
# heading to 60 arc-seconds (12 cm at the edge of the swath), the five strips of the block to 9.
source "${BASH_SOURCE[0]%/*}/tool_test.sh"

run simulate -output small -preset small -density 0.5 -noise realistic
[[ $status == 0 ]] || failed "simulate"
flight=(-trajectory small/trajectory.csv)

expect 0 "not determined: boresight_heading (" calibrate small/strip1.las small/strip2.las "${flight[@]}" -output two.json
check "two.json: the heading is not determined" awk '/"boresight_heading": \{/ { heading = 1 }
  heading && /"determined": false/ { found = 1 } heading && /\}/ { heading = 0 } END { exit !found }' two.json
check "the verdict of two.json names it" grep -q '"reason": ".*; not determined: boresight_heading (' two.json
check "the pitch of two.json is determined" awk '/"boresight_pitch": \{/ { pitch = 1 }
  pitch && /"determined": false/ { exit 1 } pitch && /\}/ { exit 0 }' two.json
expect 0 "" apply small/strip1.las corrected.las "${flight[@]}" -calibration two.json

expect 0 "usable" calibrate small/strip*.las "${flight[@]}" -control small/control.csv -output five.json
checks=$((checks + 1))
! grep -q 'not determined: ' out.txt five.json || failed "five strips determine all estimates"
checks=$((checks + 1))
! grep -q '"determined": false' <(sed '/"diagnosis"/,$d' five.json) || failed "five.json: all estimates are determined"
finish
