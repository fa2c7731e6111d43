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
check "standard deviations of all positions and angles" awk -F, 'NR > 1 {
    for (i = 8; i <= 13; ++i) if (!($i > 0 && $i < 2)) bad = 1 }
  END { exit bad || NR < 100 }' path.csv

# As SBET with its accuracies: the same positions, to a tenth of a millimetre.
expect 0 '' trajectory "${strips[@]}" -output path.sbet
check "17 values of 8 bytes for each sample" test "$(($(wc -c <path.sbet) / 136 + 1))" = "$(wc -l <path.csv)"
expect 0 '' trajectory -trajectory path.sbet -crs EPSG:32611 -trajectory_accuracy path_smrmsg.out -output back.csv
check "the SBET and its accuracies are those of the text" awk -F, '
  function off(a, b) { return a - b > b - a ? a - b : b - a }
  FNR == 1 { next }
  NR == FNR { for (i = 2; i <= 10; ++i) value[FNR, i] = $i; n = FNR; next }
  { for (i = 2; i <= 4; ++i) if (off($i, value[FNR, i]) > 1e-4) bad = 1
    for (i = 8; i <= 10; ++i) if (off($i, value[FNR, i]) > 1e-3) bad = 1 }
  END { exit bad || FNR != n }' path.csv back.csv

# A trajectory that was written is one that the tools read, with the same result as the word.
expect 0 'verdict: usable' calibrate "${strips[@]}" -trajectory reconstruct -control "$block/control.csv" \
  -output word.json -corrected calibrated
# With the trajectory from the same points, the calibration corrects them alike.
expect 0 '' apply "${strips[@]}" -corrected applied -trajectory reconstruct -calibration word.json
for strip in "${strips[@]}"; do
  check "corrected ${strip##*/}" cmp "calibrated/${strip##*/}" "applied/${strip##*/}"
done

biases() { sed -n '/"parameters"/,/"correlation"/ s/.*"\(bias\|std\)": \([^,]*\),*/\2/p' "$1"; }

# The parameters within their 95 % intervals of the block's true biases.
inside() {  # PARAMETER TRUTH
  awk -v name="\"$1\": {" -v truth="$2" 'index($0, name) { on = 1 }
    on && /"bias":/ { sub(/.*: /, ""); bias = $0 + 0 }
    on && /"std":/ { sub(/.*: /, ""); std = $0 + 0; exit }
    END { d = (bias - truth) / std; exit !(std > 0 && d * d < 1.96 ^ 2) }' word.json
}
check "roll without a trajectory" inside boresight_roll -90
check "pitch without a trajectory" inside boresight_pitch -30
check "scale without a trajectory" inside scan_angle_scale 1e-4
check "lever arm without a trajectory" inside lever_arm_x 0.05
check "range bias without a trajectory" inside range_bias 0.12

expect 0 'reconstructed from points' calibrate "${strips[@]}" -trajectory path.csv -control "$block/control.csv" \
  -output file.json
check "the file gives what the word gives" awk '{ d = $1 - $2; if (d < 0) d = -d
    if (d > 1e-3 * ($2 < 0 ? -$2 : $2) + 1e-6) bad = 1; ++n } END { exit bad || n < 16 }' \
  <(paste <(biases word.json) <(biases file.json))
check "no message of a trajectory that was not given" test -z \
  "$(sed -n '/"warnings"/,/\]/p' word.json | grep 'datum of the trajectory')"
expect 0 'm above ground' trajectory "${strips[0]}" -positions -output one.csv

# Intensities within 1 % of those with the block's trajectory (and the rounding of whole numbers).
intensities() {  # FILE: of all records of 30 bytes
  od -An -v -tu2 -w30 -j"$(od -An -tu4 -j96 -N4 "$1" | tr -d ' ')" "$1" | awk '{ print $7 }'
}
for strip in 1 4; do
  expect 0 '' intensity "$block/strip$strip.las" "own$strip.las" -trajectory reconstruct -no_fields -no_original
  expect 0 '' intensity "$block/strip$strip.las" "given$strip.las" -trajectory "$block/trajectory.csv" -no_fields -no_original
  paste <(intensities "own$strip.las") <(intensities "given$strip.las") >both.txt
  check "reflectance of strip $strip within 1 %" awk '{ d = $1 - $2; if (d < 0) d = -d
      if (d > 0.01 * $2 + 1) bad = 1; if ($1 > 0) ++n } END { exit bad || n < 10000 }' both.txt
done
expect 0 '' check "${strips[@]}" -trajectory reconstruct -output quality.json

expect 1 'option -calibration needs -trajectory' trajectory "${strips[0]}" -calibration word.json -output a.csv
expect 1 'does not end in .csv, .sbet, .out' trajectory "${strips[0]}" -output a.txt
expect 2 'no such file' trajectory absent.las -output a.csv
absent a.csv a.txt
finish
