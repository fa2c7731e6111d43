#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# Trajectories as they are delivered: several files, columns without a header, other units.
source "$(dirname -- "$0")/tool_test.sh"

csv=$block/trajectory.csv
apply=(apply "$block/strip1.las" out.las -bias boresight_roll=100)
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
  -bias boresight_roll=100
check "files before the points" cmp out.las plain.las
mkdir apart
cp parts/a.csv apart
awk -F, -v OFS=, -v OFMT=%.6f -v CONVFMT=%.6f 'NR > 1 { $2 += 0.1 } { print }' parts/b.csv >apart/b.csv
for tool in "check $block/strip?.las -output q.json" "calibrate $block/strip?.las -output c.json" \
  "intensity $block/strip1.las out.las" "apply $block/strip1.las out.las -bias boresight_roll=100"; do
  # shellcheck disable=SC2086
  expect 2 'apart/b.csv and apart/a.csv lie 0.100 m apart at * not one trajectory' $tool -trajectory apart
done
# Gaps between files stay gaps.
mkdir gap
head -n 3001 "$csv" >gap/a.csv
{ head -n 1 "$csv"; tail -n +5000 "$csv"; } >gap/b.csv
expect 2 'points have no trajectory: * in its gaps' apply "$block/strip3.las" out.las -bias boresight_roll=100 -trajectory gap
expect 1 'a.csv is given twice' "${apply[@]}" -trajectory gap/a.csv gap/a.csv

# Without a header; angles in gon; another order with a column that means nothing.
awk -F, 'NR > 1 { printf "%s 77 %s %s %s %.10f %.10f %.10f\n", $1, $3, $2, $4, $5 / 0.9, $6 / 0.9, $7 / 0.9 }' \
  "$csv" >gon.txt
expect 2 "gon.txt: line 1 holds 8 numbers, but the file has no header line: * or name the columns with -columns" \
  "${apply[@]}" -trajectory gon.txt
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

# Accuracies: 2, 2 and 3 cm, 12 and 30 arc-seconds while points are measured, more between the lines.
perl -e 'for ($t = 400990; $t < 402190; $t++) { $k = ($t - 400990) % 250 < 30 ? 1 : 50;
  print pack "d<*", $t, 0.02 * $k, 0.02 * $k, 0.03 * $k, 0, 0, 0, 0.2 * $k, 0.2 * $k, 0.5 * $k }' >smrmsg_1.out
calibrate=(calibrate "$block"/strip?.las -trajectory "$csv" -control "$block/control.csv" -output a.json)
expect 0 'over the strips: position 0.024 m, roll and pitch 12.0 arcsec, heading 30.0 arcsec' \
  "${calibrate[@]}" -trajectory_accuracy smrmsg_1.out
expect 0 'over the strips: position 0.024 m, heading 30.0 arcsec' \
  "${calibrate[@]}" -trajectory_accuracy smrmsg_1.out -roll_pitch_sigma 8
expect 0 '' "${calibrate[@]}" -position_sigma 0.0238048 -roll_pitch_sigma 12 -heading_sigma 30
mv a.json given.json
expect 0 '' "${calibrate[@]}" -trajectory_accuracy smrmsg_1.out
check "the same as the options" diff <(grep -A2 lever_arm_x given.json | cut -c1-17) \
  <(grep -A2 lever_arm_x a.json | cut -c1-17)
perl -e 'print pack "d<*", 100000, (0.02) x 9' >other.out
expect 2 'are not those of the strips' "${calibrate[@]}" -trajectory_accuracy other.out
expect 0 'accuracies of a trajectory (smrmsg), 1 200 records' info -trajectory_accuracy smrmsg_1.out
expect 2 'not a multiple of the 80' info -trajectory_accuracy "$csv"
expect 0 'heading within 2 degrees of the course' info -trajectory parts
# What is listed is in the JSON as well, with and without points.
expect 0 '' info -trajectory parts -trajectory_accuracy smrmsg_1.out -output flight.json
expect 0 '' info "$block/strip1.las" -trajectory enu.csv -output both.json
for text in '"format": "text"' '"frame": "map coordinates, those of the points assumed"' \
  '"time_kind": "seconds of the GPS week"' '"follows_course": true' '"samples_per_second": 199.99' '"records": 1200'; do
  check "flight.json has $text" grep -q "$text" flight.json
done
check "the other reading of yaw" grep -q '"would_follow_as": "an angle counter-clockwise from east' both.json
check "points beside the trajectory" grep -q '"id": "1"' both.json
expect 0 '401000.000 to 401255.740 s, seconds of the GPS week' info "$block/strip1.las" -trajectory parts/a.csv
expect 0 'it would follow it as an angle counter-clockwise from east' info -trajectory enu.csv

# Conversion: CSV to SBET and back; the points are the same with either.
expect 1 'is not known; give one with -crs' trajectory -trajectory "$csv" -output flight.sbet
printf 'time,\033[31m,y\n1,2,3\n' >control.csv  # a control character is no part of a message
expect 2 "header 'time,?" trajectory -trajectory control.csv -output flight.csv
if "$bin/pcl_als_trajectory" -trajectory "$csv" -crs EPSG:32611 -output flight.sbet >out.txt 2>err.txt; then
  rm -f out.las
  expect 0 'SBET: latitude, longitude and ellipsoidal height, datum not stated' "${apply[@]}" -trajectory flight.sbet
  check "an SBET that was written" cmp out.las plain.las
  expect 0 'turned to grid north' trajectory -trajectory flight.sbet -crs EPSG:32611 -output back.csv
  check "CSV to SBET to CSV" cmp back.csv "$csv"
  # The same as RIEGL and Leica files; seconds of the day on 2 January 2020, a Thursday, are 57400 s.
  perl -e 'open my $in, "<:raw", "flight.sbet"; local $/ = \136; my @r; push @r, [unpack "d<17", $_] while <$in>;
    my $deg = 180 / atan2(0, -1);
    open my $pof, ">:raw", "flight.pof";
    print $pof pack("a27vvVvvvq<", "RIEGL POSITION&ORIENTATION", 1, 0, 315, 2020, 1, 2, scalar @r), "\0" x 72,
      pack("CC", 1, 0), "\0" x 192;
    for (@r) { print $pof pack "d<7", $_->[0] - 4 * 86400, $_->[2] * $deg, $_->[1] * $deg, $_->[3],
      $_->[7] * $deg, $_->[8] * $deg, $_->[9] * $deg }
    open my $sol, ">:raw", "flight.sol";
    for (@r) { my $head = pack "C2vC6vvC2vd<2", 1, 2, 149, (0) x 6, 0, 0, 1, 1, 2086, $_->[0], 0;
      my $sum = 0; $sum ^= $_ for unpack "C*", $head;
      print $sol $head, pack("Cv3C", $sum, 0, 0, 0, 0), pack("d<3f<3", @$_[1, 2, 3], 0, 0, 0),
        pack("d<3f<3", @$_[7, 8, 9], 0, 0, 0), "\0" x 60, pack("f<", 47.5), "\0" x 6 }'
  for kind in pof sol; do
    expect 0 'latitude, longitude and ellipsoidal height, datum not stated' info -trajectory flight.$kind
    same "a .$kind" -trajectory flight.$kind
  done
  expect 0 'geoid undulations of 47.5 to 47.5 m, which are not applied' trajectory -trajectory flight.sol \
    -crs EPSG:32611 -output sol.csv
  # Parts of both kinds.
  mkdir both
  "$bin/pcl_als_trajectory" -trajectory parts/b.csv -crs EPSG:32611 -output both/b.sbet -quiet
  cp parts/a.csv both
  same "a CSV and an SBET" -trajectory both
else
  check "a build without PROJ says so" grep -q 'needs PROJ' err.txt
fi
expect 1 'does not end in .csv, .sbet, .out' trajectory -trajectory "$csv" -output x.txt
expect 1 'give one with -crs' trajectory -trajectory "$csv" -output x.sbet
expect 1 'option -output: *' trajectory -trajectory "$csv" -output "$csv"
absent x.txt x.sbet

# Points corrected by a calibration, and a trajectory corrected by it: only the scanner is left.
expect 0 '' calibrate "$block"/strip?.las -trajectory "$csv" -control "$block/control.csv" -output c.json
expect 0 'lever arm and strip corrections taken out' trajectory -trajectory "$csv" -calibration c.json \
  -output corrected.csv
expect 0 'lever arm taken out' trajectory -trajectory "$csv" -calibration c.json -lever_arm_only -output lever.csv
check "strip corrections differ" test "$(cksum <lever.csv)" != "$(cksum <corrected.csv)"
sed '0,/"usable"/s//"not_converged"/' c.json >bad.json
expect 1 'should not be applied' trajectory -trajectory "$csv" -calibration bad.json -output x.csv
absent x.csv
finish
