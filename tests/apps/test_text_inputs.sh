#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# Text files of users: without a header, with dates, and files that are no text at all.
source "$(dirname -- "$0")/tool_test.sh"

csv=$block/trajectory.csv
strips=("$block"/strip*.las)

# Without a header, in every table.
printf '0,5,5,3\n1,6,5,3\n' >bare.csv
expect 2 'bare.csv: line 1 holds 4 numbers, but the file has no header line: name the columns * -columns' \
  info -trajectory bare.csv
for option in "check ${strips[*]} -output x.json -control" "calibrate ${strips[*]} -trajectory $csv -output x.json -control" \
  "intensity ${strips[0]} x.las -trajectory $csv -targets" "classify ${strips[0]} -cell 5 -output x.tif -training" \
  "plan -lines" "accuracy -output x.json"; do
  # shellcheck disable=SC2086
  expect 2 'bare.csv: line 1 holds 4 numbers, but the file has no header line' $option bare.csv
  [[ $(<err.txt) != *-columns* ]] || failed "-columns names those of trajectories only"
done
absent x.json x.las x.tif

# A date beside UTC seconds of the day: 21 September 2013 is day 6 of GPS week 1758.
cat >dated.txt <<'TEXT'
Project:     flight
Program:     Inertial Explorer Version 8.50

      Date  UTCTime       Latitude      Longitude        H-Ell
     (YMD)    (sec)          (deg)          (deg)          (m)
2013/09/21 72007.50  51.1173063345 -114.0195467099     1067.619
2013/09/21 72007.60  51.1173063345 -114.0194467099     1067.619
TEXT
for leap in '' '-leap_seconds 16'; do
  # shellcheck disable=SC2086
  expect 0 'time 1063828823.500 to 1063828823.600 s, GPS seconds (2013-09-21)' info -trajectory dated.txt $leap
done

# Standard deviations in the place of the trajectory, whatever their name.
perl -e 'for ($t = 400990; $t < 401090; $t++) { print pack "d<*", $t, (0.02) x 3, (0) x 3, (0.2) x 3 }' >smrmsg_1.out
cp smrmsg_1.out accuracy.sbet
cp smrmsg_1.out accuracy.csv
head -c 1000 smrmsg_1.out >smrmsg_cut.out
perl -e 'print "RIEGL POSITION&ORIENTATION QUALITY\0", pack("vvV", 1, 0, 67), "\0" x 24;
  for ($t = 0; $t < 9; $t++) { print pack("d<8v", 1000 + $t, (0.02) x 3, (0.003) x 3, 1, 9) }' >flight.poq
cp flight.poq renamed.pos
for file in smrmsg_1.out accuracy.sbet accuracy.csv smrmsg_cut.out flight.poq renamed.pos; do
  expect 2 "$file: holds the standard deviations of a trajectory, not its positions: * this file is one for -trajectory_accuracy" \
    info -trajectory $file
done
expect 2 'holds the standard deviations of a trajectory' intensity "${strips[0]}" x.las -trajectory smrmsg_1.out
[[ $(<err.txt) != *-trajectory_accuracy* ]] || failed "pcl_als_intensity has no -trajectory_accuracy"
expect 0 'accuracies of a trajectory (smrmsg)' info -trajectory_accuracy accuracy.csv
# An SBET that is damaged is none of these.
head -c 1000 /dev/zero >zeros.sbet
expect 2 'not a multiple of the 136 of an SBET record' info -trajectory zeros.sbet

# No bytes of a binary file reach the terminal, whatever it is given for.
printable() {
  iconv -f UTF-8 -t UTF-8 out.txt err.txt >/dev/null 2>&1 && ! grep -qP '[\x00-\x08\x0B-\x1F\x7F]' out.txt err.txt
}
perl -e 'srand 7; print join "", map { chr(1 + int rand 255) } 1 .. 4000' >random.csv
printf 'id,x,y,z\n\xff\xfe\x9b31m,1,\x1b[2J,3\n' >escapes.csv
printf '{"for\x9b\x1bmat": "\xff\xfe\x1b[2J"}' >escapes.json
printf 'VERSION 0.7\nFI\x9bELDS x\xff\n' >escapes.pcd
printf 'time,x,y,\x9b\x1b[2J\n1,2,3,4\n' >escapes.txt
for file in random.csv escapes.csv escapes.json escapes.pcd escapes.txt "${strips[0]}" smrmsg_1.out; do
  for option in "check ${strips[*]} -output x.json -control" "info -trajectory" "info -trajectory_accuracy" "plan -lines" "accuracy -output x.json" \
    "apply ${strips[0]} x.las -trajectory $csv -calibration" "classify ${strips[0]} -cell 5 -output x.tif -training" \
    "intensity ${strips[0]} x.las -trajectory $csv -targets"; do
    # shellcheck disable=SC2086
    run $option "$file"
    checks=$((checks + 1))
    [[ $(wc -l <err.txt) -le 1 ]] && printable || failed "pcl_als_$option $file: bytes of the file"
  done
done
run info escapes.pcd
printable || failed "pcl_als_info escapes.pcd"
absent x.json x.las x.tif
finish
