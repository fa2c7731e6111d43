#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# Trajectories that do not belong to the points: every tool that takes one refuses them, names the likely cause, and
# goes on with -force. Until 2026-11 only pcl_als_calibrate did, and none looked at the attitude; a negated roll was
# accepted in longer, and pcl_als_intensity said nothing of the attitude.
source "$(dirname -- "$0")/tool_test.sh"

# variant NAME PROGRAM: the block's trajectory, each record changed by an awk program (columns $1 to $7).
variant() {
  awk -F, -v OFS=, -v OFMT=%.9f -v CONVFMT=%.9f "NR > 1 { $2 } { print }" "$block/trajectory.csv" >"$1.csv"
}
variant feet '$2 /= 0.3048; $3 /= 0.3048; $4 /= 0.3048'
variant xy 't = $2; $2 = $3; $3 = t'
variant xz 't = $2; $2 = $4; $4 = t'
variant far '$2 += 400000'
variant radians '$5 /= 57.29578; $6 /= 57.29578; $7 /= 57.29578'
variant zeros '$5 = 0; $6 = 0; $7 = 0'
variant east '$7 = 90 - $7'
variant tail '$7 += 180'

strips=("$block"/strip*.las)
calibrate=(calibrate "${strips[@]}" -control "$block/control.csv" -output c.json)
check=(check "${strips[@]}" -output q.json)
apply=(apply "$block/strip1.las" out.las -bias boresight_roll=100)
intensity=(intensity "$block/strip1.las" out.las)
# Likely causes are named; a trajectory in metres and points in feet are never used together. The listing of
# pcl_als_info says the same and ends well.
variant points_in_feet '$2 *= 0.3048; $3 *= 0.3048; $4 *= 0.3048'
variant heights_in_feet '$4 *= 0.3048'
variant degrees '$2 = -114 + 1e-6 * $2; $3 = 51 + 1e-7 * $3'
variant zone '$2 -= 415000'
while read -r wrong text; do
  for tool in calibrate check apply intensity; do
    declare -n command=$tool
    expect 2 "$text" "${command[@]}" -trajectory "$wrong.csv"
  done
  expect 0 "! *$text" info "${strips[@]}" -trajectory "$wrong.csv"
  absent out.las
done <<'CAUSES'
feet strip *: its points lie * m *with its coordinates in feet*the trajectory of this flight
points_in_feet with theirs in feet
heights_in_feet with their heights in feet
xy strip *: its points lie * m *with x and y exchanged*the trajectory of this flight
xz strip *: its points lie * m *with x and z exchanged*the trajectory of this flight
far strip *: its points lie * m * the trajectory of this flight
degrees its coordinates look like degrees
zone a zone 6 degrees away
CAUSES
variant datum '$2 += 150'
expect 2 'as between two geodetic datums' "${calibrate[@]}" -trajectory datum.csv
expect 2 'as between two geodetic datums' "${check[@]}" -trajectory datum.csv
# UTC: points that were measured 18 s of flight away.
awk -F, -v OFS=, -v CONVFMT=%.9f -v OFMT=%.9f 'NR == 1 { print } $1 > 401000 && $1 < 401006 {
    if (!n++) { t = $1; x = $2; y = $3 } else { u = ($2 - x) / ($1 - t); v = ($3 - y) / ($1 - t) }
    z = $4; rest = $5 OFS $6 OFS $7 }
  END { for (s = -40; s <= 40; s += 0.1) print t + s - 18, x + u * s, y + v * s, z, rest }' \
  "$block/trajectory.csv" >utc.csv
for tool in check intensity apply; do
  expect 2 'as if the times of the trajectory were UTC*state them with -leap_seconds' \
    $tool "$block/strip1.las" $([[ $tool == check ]] && echo "$block/strip2.las -output q.json" || echo out.las) \
    $([[ $tool == apply ]] && echo -bias boresight_roll=100) -trajectory utc.csv
done
expect 0 '! *as if the times of the trajectory were UTC*state them with -leap_seconds' \
  info "$block/strip1.las" -trajectory utc.csv
expect 0 'scanner of 1' info "$block/strip1.las" -trajectory utc.csv -leap_seconds 18 -output utc.json
check "with the leap seconds nothing is wrong" grep -q '"flight_remarks": \[\]' utc.json
# Times of another GPS week or of the day.
awk -F, -v OFS=, -v OFMT=%.6f -v CONVFMT=%.6f 'NR > 1 { $1 -= 345600 } { print }' "$block/trajectory.csv" >day.csv
expect 2 'they would overlap 4 day(s) earlier' "${apply[@]}" -trajectory day.csv
expect 0 '! the trajectory cannot be used with the points: *they would overlap 4 day(s) earlier' \
  info "$block/strip1.las" -trajectory day.csv
run simulate -output week -preset small -scale 0.3 -density 0.1 -noise range -seed 5 -time adjusted
awk -F, -v OFS=, -v OFMT=%.6f -v CONVFMT=%.6f 'NR > 1 { $1 += 1543 * 604800 - 1e9 } { print }' \
  week/trajectory.csv >week.csv
expect 2 'they would overlap 3 week(s) later: the GPS week of one of them is wrong' \
  apply week/strip1.las out.las -bias boresight_roll=100 -trajectory week.csv
for tool in calibrate check apply; do
  declare -n command=$tool
  expect 2 'would as in radians' "${command[@]}" -trajectory radians.csv
  expect 2 'a column without values' "${command[@]}" -trajectory zeros.csv
  expect 2 'counter-clockwise from east' "${command[@]}" -trajectory east.csv
  expect 2 'heading + 180 degrees' "${command[@]}" -trajectory tail.csv
done
# Positions are all that intensities need: the attitude is remarked on.
while read -r wrong text; do
  expect 0 "$text*only positions are used here" "${intensity[@]}" -trajectory "$wrong.csv"
  rm -f out.las
done <<'ATTITUDES'
radians would as in radians
zeros a column without values
east counter-clockwise from east
tail heading + 180 degrees
ATTITUDES
# Signs of pitch and roll show in the motion of a few seconds and a dense swath.
run simulate -output long -preset small -noise range -seed 1
while read -r name change text; do
  awk -F, -v OFS=, -v OFMT=%.9f -v CONVFMT=%.9f "NR > 1 { $change } { print }" long/trajectory.csv >"long/$name.csv"
  expect 2 "$text" calibrate long/strip?.las -trajectory "long/$name.csv" -output c.json
  expect 2 "$text" check long/strip?.las -trajectory "long/$name.csv" -output q.json
  expect 2 "strip2.las: $text" apply long/strip2.las out.las -trajectory "long/$name.csv" -bias boresight_roll=100
  expect 0 "$text" intensity long/strip2.las out.las -trajectory "long/$name.csv"
  rm -f out.las
done <<'SIGNS'
roll $5=-$5 the roll of the trajectory has the opposite sign
pitch $6=-$6 the pitch of the trajectory has the opposite sign
both $5=-$5;$6=-$6 the pitch of the trajectory has the opposite sign
exchanged t=$5;$5=$6;$6=t the pitch that the points show is the roll of the trajectory
radians $5/=57.29578;$6/=57.29578 the pitch of the trajectory changes by a 57th
SIGNS
awk -F, -v OFS=, 'NR > 1 { $5 = 0; $6 = 0 } { print }' long/trajectory.csv >long/level.csv
expect 0 'warning: the pitch of the trajectory is the same at all times' \
  apply long/strip2.las out.las -trajectory long/level.csv -bias boresight_roll=100
rm -rf out.las long/*.las
# Heights in feet: scan angles that are recorded show it. The calibration judges the parameters.
awk -F, -v OFS=, 'NR > 1 { $4 /= 0.3048 } { print }' "$block/trajectory.csv" >tall.csv
for tool in check apply intensity; do
  declare -n command=$tool
  expect 2 'm too high by the recorded scan angles' "${command[@]}" -trajectory tall.csv
done
expect 3 'm too high by the recorded scan angles' "${calibrate[@]}" -trajectory tall.csv -quiet
expect 0 '! *m too high by the recorded scan angles' info "${strips[@]}" -trajectory tall.csv
# Ellipsoidal heights of the trajectory, points above a geoid: named, and brought together by the undulation.
awk -F, -v OFS=, -v OFMT=%.9f -v CONVFMT=%.9f 'NR > 1 { $4 += 47 } { print }' "$block/trajectory.csv" >ellipsoidal.csv
expect 0 '47 m too high*as between ellipsoidal heights and heights above a geoid' "${check[@]}" -trajectory ellipsoidal.csv
# The rays through several returns of a pulse leave no doubt; beside the line and late as well.
variant aside '$2 += 60; $3 += 60'
variant late '$1 += 1'
for tool in apply intensity; do
  declare -n command=$tool
  expect 2 'up 47)*as between ellipsoidal heights and heights above a geoid' "${command[@]}" -trajectory ellipsoidal.csv
  expect 2 'lies 85 m (east 60, north 60, up 0) beside' "${command[@]}" -trajectory aside.csv
  expect 2 '1.00 s of flight, as if two clocks differed' "${command[@]}" -trajectory late.csv
  absent out.las
  expect 0 'rays through several returns' "${command[@]}" -trajectory late.csv -force
  rm -f out.las
done
expect 0 'geoid subtracts the undulation' "${check[@]}" -trajectory ellipsoidal.csv
expect 3 'heights above a geoid' "${calibrate[@]}" -trajectory ellipsoidal.csv
expect 0 '' "${apply[@]}" -trajectory "$block/trajectory.csv"
mv out.las right.las
expect 0 'geoid undulation subtracted' "${apply[@]}" -trajectory ellipsoidal.csv -geoid 47
check "the undulation brings heights together" cmp out.las right.las
rm -f out.las right.las
# 50 m at one flying height may also be a factor of the angles: standard deviations include it.
awk -F, -v OFS=, 'NR > 1 { $4 += 50 } { print }' "$block/trajectory.csv" >high.csv
expect 0 'the standard deviations of lever_arm_x* include that the height of the trajectory may be wrong' \
  calibrate "$block"/strip[12].las -control "$block/control.csv" -output c.json -trajectory high.csv
# Times of one strip in whole seconds: the calibration leaves it out, the check goes without its path.
"$damage" "$block/strip3.las" whole.las whole_seconds || failed damage
others=("$block"/strip[1245].las)
expect 0 'strip is excluded' calibrate "${others[@]}" whole.las -control "$block/control.csv" -output c.json \
  -trajectory "$block/trajectory.csv"
check "it is counted" grep -q '"reason": "rounded_times"' c.json
expect 0 "its scan angles are the file's" check "${others[@]}" whole.las -output q.json \
  -trajectory "$block/trajectory.csv"
expect 2 'its times are whole seconds' apply whole.las out.las -bias boresight_roll=100 \
  -trajectory "$block/trajectory.csv"
# What is refused can be forced; a warning stays.
expect 0 'warning: the heading' "${apply[@]}" -trajectory tail.csv -force
# Options of a trajectory are checked where none is read, too.
expect 1 "option -crs: 'nonsense' is not known to PROJ" check "${strips[@]}" -output q.json -crs nonsense
expect 1 "option -line_fit: 'long' is not a number from" check "${strips[@]}" -output q.json -line_fit long
expect 1 "option -trajectory_units: 'miles'" check "${strips[@]}" -output q.json -trajectory_units miles
# Warnings with a remedy name the options of the tool in every output.
expect 0 'is not checked; see -control' calibrate "${strips[@]}" -trajectory "$block/trajectory.csv" -output c.json
check "the option is in the result" grep -q 'is not checked; see -control' c.json
# An output without any intensity left is no answer, but it is written.
rm -f out.las
expect 3 'intensities are beyond 65535' "${intensity[@]}" -trajectory xz.csv -force
check "the output is there" test -s out.las
# The course tells what a column called yaw is; other names are taken as they are in use.
sed '1s/.*/GpsTime,Easting,Northing,Height,Roll,Pitch,Yaw/' east.csv >yaw.csv
sed '1s/.*/"gps_time","EASTING","Y (m)","Elevation","roll_deg","Pitch","Azimuth"/' "$block/trajectory.csv" >names.csv
expect 0 '' "${apply[@]}" -trajectory "$block/trajectory.csv"
mv out.las plain.las
expect 0 'yaw is counter-clockwise from east' "${apply[@]}" -trajectory yaw.csv
rm -f out.las
expect 0 'columns: time from gps_time, x from EASTING' "${apply[@]}" -trajectory names.csv
check "names change nothing" cmp out.las plain.las
finish
