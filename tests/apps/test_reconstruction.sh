#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# The trajectory of strips from their points, by itself and in the jobs that need one.
source "$(dirname -- "$0")/tool_test.sh"

strips=("$block"/strip?.las)
expect 0 'm above ground, std' trajectory "${strips[@]}" -output path.csv
check "columns of standard deviations" grep -q '^time,x,y,z,roll,pitch,heading,sd_east' path.csv

# Largest difference in a coordinate to the block's own trajectory at the same times, metres.
largest=$(awk -F, 'FNR == 1 { next }
  NR == FNR { x[sprintf("%.3f", $1)] = $2; y[sprintf("%.3f", $1)] = $3; z[sprintf("%.3f", $1)] = $4; next }
  { t = sprintf("%.3f", $1) }
  t in x { for (i = 0; i < 3; ++i) { d = i == 0 ? $2 - x[t] : i == 1 ? $3 - y[t] : $4 - z[t]
             if (d < 0) d = -d; if (d > most) most = d }; ++n }
  END { print (n > 100 && most < 1) }' "$block/trajectory.csv" path.csv)
check "positions within a metre of the block's trajectory" test "$largest" = 1

# A trajectory that was written is one that the tools read, with the same result as the word.
expect 0 'verdict: usable' calibrate "${strips[@]}" -trajectory reconstruct -control "$block/control.csv" \
  -output word.json
check "lever arm and range bias are not determined" test "$(grep -c not_estimable word.json)" -ge 4

expect 0 'reconstructed from points' calibrate "${strips[@]}" -trajectory path.csv -control "$block/control.csv" \
  -output file.json
check "the file is known to be reconstructed" test "$(grep -c not_estimable file.json)" -ge 4
expect 0 'm above ground' trajectory "${strips[0]}" -positions -output one.csv
expect 0 '' intensity "${strips[0]}" out.las -trajectory reconstruct
expect 0 '' check "${strips[@]}" -trajectory reconstruct -output quality.json

expect 1 'pcl_als_trajectory first' apply "${strips[0]}" out2.las -trajectory reconstruct -biases boresight_roll=10
expect 1 'need -trajectory' trajectory "${strips[0]}" -calibration word.json -output a.csv
expect 1 'is written as .csv, .sbet or .out' trajectory "${strips[0]}" -output a.txt
expect 2 'no such file' trajectory absent.las -output a.csv
absent a.csv a.txt out2.las
finish
