#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# PCD files of other programs: names of fields, fields that are lost, times that are none.
source "$(dirname -- "$0")/tool_test.sh"
flight=(-trajectory "$block/trajectory.csv")

# Whatever copies a PCD names the fields that the copy lacks.
for k in 1 2 3; do
  expect 0 "points" convert "$block/strip$k.las" "strip$k.pcd"
  expect 0 "points" intensity "strip$k.pcd" "more$k.pcd" "${flight[@]}" -no_atmosphere
done
lost="not used: original_intensity"
expect 0 "$lost" info more1.pcd
expect 0 "$lost" convert more1.pcd copy.pcd
expect 0 "$lost" convert more1.pcd copy.las
expect 0 "$lost" apply more1.pcd copy.pcd "${flight[@]}" -bias range_bias=0.01
expect 0 "more1.pcd: its fields are $lost" intensity more1.pcd copy.pcd "${flight[@]}" -no_atmosphere -force
expect 0 "$lost" icpatch more1.pcd more2.pcd -output pair.json -transformed moved.pcd
expect 0 "more1.pcd: its fields are $lost" classify more?.pcd -training "$block/training.csv" -cell 5 \
  -output map.tif -classified classes -bands intensity,roughness
# Nothing is lost of the fields that all have.
expect 0 "points" apply strip1.pcd copy.pcd "${flight[@]}" -bias range_bias=0.01
check "nothing is said to be lost" test "$(grep -c 'not used' out.txt)" = 0

# Fields of PDAL, among them the channel of the scanner.
printf '%s\n' 'VERSION 0.7' 'FIELDS X Y Z GpsTime Intensity PointSourceId UserData Red' 'SIZE 8 8 8 8 4 2 1 2' \
  'TYPE F F F F F U U U' 'COUNT 1 1 1 1 1 1 1 1' 'WIDTH 2' 'HEIGHT 1' 'VIEWPOINT 0 0 0 1 0 0 0' 'POINTS 2' \
  'DATA ascii' '500000 5400000 100 269347.28 80 17 1 9' '500001 5400002 101 269347.29 81 17 2 9' >pdal.pcd
expect 0 "269347.280 … 269347.290" info pdal.pcd
expect 0 "its field is not used: Red" info pdal.pcd
expect 2 "fewer than two strips" check pdal.pcd -channels user_data -output x.json  # of two points
expect 2 "no field 'laser'" check pdal.pcd -channels laser -output x.json

# Times whose bytes were averaged: the upper half of each is the float of the intensity behind it.
{
  printf '%s\n' 'VERSION 0.7' 'FIELDS x y z gps_time intensity' 'SIZE 4 4 4 8 4' 'TYPE F F F F F' \
    'COUNT 1 1 1 1 1' 'WIDTH 3000' 'HEIGHT 1' 'VIEWPOINT 0 0 0 1 0 0 0' 'POINTS 3000' 'DATA binary'
  perl -e 'for my $i (0 .. 2999) { my $mean = pack("f<", 8 + $i % 10);
    print pack("f<3", $i % 50, int($i / 50), 0), pack("V", 7), $mean, $mean }'
} >averaged.pcd
fault="averaged.pcd: its GPS times are not used, they are averages of bytes*pcl::VoxelGrid<PointLidar>"
expect 0 "averages of bytes" info averaged.pcd
expect 0 "averages of bytes" convert averaged.pcd copy.las
expect 2 "$fault" apply averaged.pcd x.pcd "${flight[@]}" -bias range_bias=0.01
expect 2 "$fault" intensity averaged.pcd x.pcd "${flight[@]}"
expect 2 "$fault" calibrate averaged.pcd "${flight[@]}" -output x.json
expect 2 "$fault" trajectory averaged.pcd -output x.csv
expect 2 "$fault" calibrate averaged.pcd -trajectory reconstruct -output x.json
run calibrate averaged.pcd strip1.pcd strip2.pcd "${flight[@]}" -output y.json
cp out.txt beside.txt
check "beside others it is named" grep -q "averaged.pcd: its GPS times are not used" beside.txt
absent x.pcd x.json x.csv
finish
