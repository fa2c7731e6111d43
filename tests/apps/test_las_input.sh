#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# Damaged, lying and useless point files: exit status 2, one line naming the file, no output.
source "$(dirname -- "$0")/tool_test.sh"
trajectory=$block/trajectory.csv

# refused FILE TEXT: by every tool that reads points.
refused() {
  expect 2 "$1*$2" apply "$1" x.las -trajectory "$trajectory" -bias range_bias=0.1
  absent x.las
  expect 2 "$1*$2" calibrate "$1" "$block/strip2.las" -trajectory "$trajectory" -output x.json
  absent x.json
  expect 2 "$1*$2" info "$1"
}
# damaged NAME TEXT CHANGE…: strip1 with the change is refused.
damaged() {
  check "las_damage" "$damage" "$block/strip1.las" "$1.las" "${@:3}"
  refused "$1.las" "$2"
}

refused missing.las ""
: >empty.las
refused empty.las ""
mkdir folder.las
refused folder.las ""
echo "x,y,z" >text.las
refused text.las ""
cp "$block/strip1.las" strip.xyz
expect 2 "strip.xyz" calibrate strip.xyz "$block/strip2.las" -trajectory "$trajectory" -output x.json
absent x.json
expect 2 "strip.xyz" info strip.xyz

damaged truncated_header "" keep 200
damaged truncated_vlr "" keep 400
damaged truncated_point "" keep 100001
damaged no_signature "" set signature 0
damaged version "version" set version_minor 9
damaged version_6 "LAS version 1.6 is not supported (1.0 to 1.5 are)" set version_minor 6
damaged version_5 "version 1.5 has 393" set version_minor 5
damaged format "format" set point_format 11
damaged record_length "record" set record_length 12
damaged count_too_large "" set point_count 99999999
damaged count_huge "" set point_count 0xffffffffffffffff
damaged offset_beyond "" set offset_to_points 0x7fffffff
damaged offset_in_header "" set offset_to_points 10
damaged vlr_length "" set vlr_length 65535
damaged evlr_beyond "" set evlr_count 3 set evlr_start 0xfffffffffffffff0
damaged nan_scale "scale" set scale_x nan
damaged infinite_scale "scale" set scale_x inf
damaged zero_scale "scale" set scale_x 0
damaged nan_offset "offset" set offset_x nan

# The points do not depend on the number of VLRs: it is corrected in what is written.
check "las_damage" "$damage" "$block/strip1.las" vlr_count.las set vlr_count 1000000
expect 0 "the header announces 1 000 000 VLRs, but there is room for 2 before the points" info vlr_count.las
expect 0 "there is room for 2" convert vlr_count.las right.las
check "the copy has the right number of VLRs" cmp right.las "$block/strip1.las"

# Without times the geometry at the firing is unknown; what the file holds can still be listed.
for case in "zero_times zero_times" "no_time_format set point_format 0 set version_minor 2 set header_size 227"; do
  read -ra words <<<"$case"
  check "las_damage" "$damage" "$block/strip1.las" "${words[0]}.las" "${words[@]:1}"
done
expect 2 "zero_times.las*time" apply zero_times.las x.las -trajectory "$trajectory" -bias range_bias=0.1
absent x.las
expect 2 "17206 of 17206 points*their GPS time is 0" calibrate zero_times.las "$block/strip2.las" -trajectory "$trajectory" -output x.json
absent x.json

# A file without points is nothing to calibrate with, but can be listed and copied.
check "las_damage" "$damage" "$block/strip1.las" no_points.las set point_count 0
expect 2 "" calibrate no_points.las "$block/strip2.las" -trajectory "$trajectory" -output x.json
absent x.json
expect 0 "no points" info no_points.las

# Ids of pulses: what is wrong is named, and the listing remains one that can be read.
check "las_damage" "$damage" "$block/strip1.las" pulses.las pulse_ids
expect 0 "! there are 17 206 point source ids*-split divides the points into flight lines" info pulses.las -output pulses.json
check "a long list is cut" test "$(wc -l <out.txt)" -lt 400
check "the JSON file has all strips" test "$(grep -c '"recorded_with"' pulses.json)" = 17206

# An input is never an output.
cp "$block/strip1.las" mine.las
expect 1 "mine.las" apply mine.las mine.las -trajectory "$trajectory" -bias range_bias=0.1
ln -s mine.las link.las
expect 1 "link.las" apply mine.las link.las -trajectory "$trajectory" -bias range_bias=0.1
check "input untouched" cmp "$block/strip1.las" mine.las
finish
