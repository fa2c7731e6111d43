#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# pcl_als_plan: bad plans and grids, what a block lacks, and its promise held against a calibration
# of the same lines flown in the simulator.
source "$(dirname -- "$0")/tool_test.sh"

pairs() { printf 'id,x1,y1,x2,y2,height\n'; printf '%s\n' "$@"; }
pairs 1,0,0,0,1500,1000 2,0,1500,0,0,1000 >two.csv

expect 1 "lines" plan
expect 1 "usage" plan two.csv
expect 1 "fov" plan -lines two.csv -fov 0
expect 1 "sloped" plan -lines two.csv -sloped 2
expect 1 "density" plan -lines two.csv -pulse_density many
expect 1 "density and -spacing" plan -lines two.csv -pulse_density 1 -spacing 1
expect 1 "control" plan -lines two.csv -control -1
expect 1 "wobble" plan -lines two.csv -estimate wobble
expect 2 "none.csv: *there is no such file" plan -lines none.csv
expect 2 "the folder does not exist" plan -lines two.csv -output nowhere/plan.json

: >empty.csv
expect 2 "empty.csv: is empty" plan -lines empty.csv
pairs >header.csv
expect 2 "has a header but no lines" plan -lines header.csv
printf 'id,x1,y1,x2,y2\n1,0,0,0,9\n' >column.csv
expect 2 "no column 'height'" plan -lines column.csv
pairs 1,0,0,0,1500,1000 2,0,north,0,0,1000 >text.csv
expect 2 "text.csv: line 3, column 'y1': 'north' is not a number" plan -lines text.csv
pairs 1,0,0,0,1500,nan >nan.csv
expect 2 "column 'height'" plan -lines nan.csv
pairs 1,5,5,5,5,1000 >point.csv
expect 2 "line 2, column 'x2'*no length" plan -lines point.csv
pairs 1,0,0,0,1500,0 >ground.csv
expect 2 "column 'height'*more than 0" plan -lines ground.csv
pairs 1,0,0,0,1500,1000 1,0,1500,0,0,1000 >twice.csv
expect 2 "column 'id': '1' names two lines" plan -lines twice.csv
pairs 1,0,0,0,1500,99999 >space.csv
expect 2 "space.csv: line 1: height*outside" plan -lines space.csv
pairs 1,0,0,0,1500,500 2,9000,0,9000,1500,500 >apart.csv
expect 2 "no two lines overlap" plan -lines apart.csv

grid() { printf 'ncols %s\nnrows %s\nxllcorner -1000\nyllcorner -1000\ncellsize 1000\nNODATA_value -9999\n' "$1" "$2"; }
{ grid 4 4; echo "0 20 0 10 30 5 60 0 10 7 20 40 0 80 -9999 0"; } >good.asc
expect 0 "4 x 4 cells" plan -lines two.csv -terrain good.asc -sloped 0.1
# A grid somewhere else is refused, one below a part of the lines is told.
{ printf 'ncols 2\nnrows 2\nxllcorner 900000\nyllcorner 0\ncellsize 1000\n'; echo "0 20 0 10"; } >far.asc
expect 2 "far.asc: has no elevation below any of the lines *its nearest cell is 900.2 km away*" \
  plan -lines two.csv -terrain far.asc
{ printf 'ncols 2\nnrows 2\nxllcorner -1000\nyllcorner -500\ncellsize 1000\n'; echo "0 20 0 10"; } >part.asc
expect 0 "the terrain covers 67 % of the swaths" plan -lines two.csv -terrain part.asc -sloped 0.1
{ grid 4 4; echo "0 20 0 10 30"; } >short.asc
expect 2 "declares 16 values" plan -lines two.csv -terrain short.asc
{ grid 999999 999999; echo "0 20 0 10 30"; } >lying.asc
expect 2 "declares 999998000001 values" plan -lines two.csv -terrain lying.asc
{ grid 2 2; echo "0.25 20.25 nan 10.25"; } >hole.asc
expect 2 "'nan' is not a finite number" plan -lines two.csv -terrain hole.asc
{ grid 2 2; echo "1.25 2.25 3.25 4.25 5"; } >long.asc
expect 2 "more values than the header declares" plan -lines two.csv -terrain long.asc
printf 'ncols 2\nnrows 2\n1 2 3 4\n' >bare.asc
expect 2 "no 'cellsize'" plan -lines two.csv -terrain bare.asc
printf 'ncols -2\nnrows 2\ncellsize 1\nxllcorner 0\nyllcorner 0\n1 2 3 4\n' >minus.asc
expect 2 "'ncols' must be a whole number" plan -lines two.csv -terrain minus.asc
: >empty.asc
expect 2 "empty.asc: is empty" plan -lines two.csv -terrain empty.asc
absent nowhere plan.json

# What one height over a plane lacks, in words; asked for by name it is no reliable answer, but the
# file is written.
expect 0 "lever_arm_y with boresight_pitch*single flying height (1000 m)" \
  plan -lines two.csv -ground_slope 0 -sloped 0.02
expect 0 "range_bias*no control" plan -lines two.csv
expect 3 "lever_arm_y will not be determined" \
  plan -lines two.csv -estimate lever_arm_y,boresight_pitch -output plan.json
check "plan.json says so" grep -q '"determined": false' plan.json
check "plan.json has its format" grep -q '"format": "pcl_als plan"' plan.json
check "plan.json has advice" grep -q 'an opposite line at a second height' plan.json

# The small block of the simulator: two opposite lines at 1150 m, three at 540 m across them.
seven=lever_arm_x,lever_arm_y,boresight_pitch,boresight_roll,boresight_heading,range_bias,scan_angle_scale
cat >small.csv <<'END'
id,x1,y1,x2,y2,height,density
1,-83.71,225,-83.71,-225,1150,0.5
2,83.71,-225,83.71,225,1150,0.5
3,225,-147.41,-225,-147.41,540,1
4,-225,-49.14,225,-49.14,540,1
5,-225,147.41,225,147.41,540,1
END
expect 0 "10 overlapping pairs" plan -lines small.csv -control 37 -estimate "$seven" -output plan.json
check "simulating the block" "$bin/pcl_als_simulate" -output block -preset small -noise realistic -seed 2 -quiet
check "calibrating the block" "$bin/pcl_als_calibrate" block/strip{1,2,3,4,5}.las -quiet -estimate "$seven" \
  -trajectory block/trajectory.csv -control block/control.csv -output calibration.json

stds() {  # FILE: "name std" of every parameter that has one
  awk -F'[":,]+' '$2 ~ /^(lever_arm|boresight|range_bias|scan_angle)/ && $3 ~ /{/ { name = $2 }
    $2 == "std" && name != "" && $3 + 0 > 0 { print name, $3; name = "" }' "$1"
}
check "seven parameters in both files" \
  test "$(stds plan.json | wc -l) $(stds calibration.json | wc -l)" = "7 7"
check "the promise holds within a factor of two" awk '
  NR == FNR { planned[$1] = $2; next }
  { ratio = planned[$1] / $2; print $1, ratio; if (!(ratio > 0.5 && ratio < 2)) bad = 1 }
  END { exit bad }' <(stds plan.json) <(stds calibration.json)
finish
