#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# Trajectories as they are delivered: several files, columns without a header, other units.
source "$(dirname -- "$0")/tool_test.sh"

csv=$block/trajectory.csv
apply=(apply "$block/strip1.las" out.las -biases boresight_roll=100)
expect 0 '' "${apply[@]}" -trajectory "$csv"
mv out.las plain.las
same() {  # WHAT OPTION…: the points corrected with this trajectory are those of the block's
  rm -f out.las
  expect 0 '' "${apply[@]}" "${@:2}"
  check "$1" cmp out.las plain.las
}

# Two overlapping parts, in any order, before or after the point files, or in a folder.
mkdir parts
head -n 3001 "$csv" >parts/a.csv
{ head -n 1 "$csv"; tail -n +2500 "$csv"; } >parts/b.csv
same "two files" -trajectory parts/b.csv parts/a.csv
same "a folder" -trajectory parts
rm -f out.las
expect 0 'repeat those of other files' apply -trajectory parts/a.csv parts/b.csv "$block/strip1.las" out.las \
  -biases boresight_roll=100
check "files before the points" cmp out.las plain.las
mkdir apart
cp parts/a.csv apart
awk -F, -v OFS=, -v OFMT=%.6f -v CONVFMT=%.6f 'NR > 1 { $2 += 0.1 } { print }' parts/b.csv >apart/b.csv
for tool in "check $block/strip?.las -output q.json" "calibrate $block/strip?.las -output c.json" \
  "intensity $block/strip1.las out.las" "apply $block/strip1.las out.las -biases boresight_roll=100"; do
  # shellcheck disable=SC2086
  expect 2 'apart/b.csv and apart/a.csv lie 0.100 m apart at * not one trajectory' $tool -trajectory apart
done
# Gaps between files stay gaps.
mkdir gap
head -n 3001 "$csv" >gap/a.csv
{ head -n 1 "$csv"; tail -n +5000 "$csv"; } >gap/b.csv
expect 2 'points have no trajectory: * in its gaps' apply "$block/strip3.las" out.las -biases boresight_roll=100 -trajectory gap
expect 1 'a.csv is given twice' "${apply[@]}" -trajectory gap/a.csv gap/a.csv

# Without a header; angles in gon; another order with a column that means nothing.
awk -F, 'NR > 1 { printf "%s 77 %s %s %s %.10f %.10f %.10f\n", $1, $3, $2, $4, $5 / 0.9, $6 / 0.9, $7 / 0.9 }' \
  "$csv" >gon.txt
expect 2 "accepted names * or name the columns with -columns" "${apply[@]}" -trajectory gon.txt
columns=time,skip,northing,easting,height,roll,pitch,heading
rm -f out.las
expect 0 '' "${apply[@]}" -trajectory gon.txt -columns $columns -trajectory_angles gon
check "columns by name" cmp out.las plain.las
expect 2 'does not follow its course' "${apply[@]}" -trajectory gon.txt -columns $columns -trajectory_angles rad
expect 1 "'grad' is none of deg, rad, gon" "${apply[@]}" -trajectory gon.txt -trajectory_angles grad
# Axes east, north, up: pitch nose down, yaw from east.
awk -F, -v OFS=, -v OFMT=%.9f -v CONVFMT=%.9f 'NR > 1 { $6 = -$6; $7 = 90 - $7 } { print }' "$csv" >enu.csv
same "axes of east, north, up" -trajectory enu.csv -trajectory_axes enu
# UTC is stated by its offset.
awk -F, -v OFS=, -v OFMT=%.6f -v CONVFMT=%.6f 'NR == 1 { $1 = "UTCTime" } NR > 1 { $1 -= 18 } { print }' "$csv" >utc.csv
expect 2 'leap seconds* -leap_seconds' "${apply[@]}" -trajectory utc.csv
same "times in UTC" -trajectory utc.csv -leap_seconds 18
finish
