#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# pcl_als_lines and pcl_als_orient as a user runs them, on a block with images, and what they must
# refuse.
source "$(dirname -- "$0")/tool_test.sh"
"$bin/pcl_als_simulate" -quiet -output flown -preset small -noise range -density 3 -images -bias none
images=flown/images
orient=(orient -images $images/images.csv -camera $images/camera.json)

expect 0 "ridge" lines flown/strip*.las -output lines.csv
check "lines are seen in several strips" grep -qE ',[0-9]+ [0-9]+' lines.csv
expect 0 "" lines flown/strip3.las -output lines.geojson
check "GeoJSON of lines" grep -q '"LineString"' lines.geojson

# value KEY INDEX FILE: a number of a list in orientation.json
value() {
  awk -v key="\"$1\":" -v index_="$2" '/"check_points":/ { on = 1 } on && $1 == key { take = 1; next }
    take && /[0-9]/ { if (take++ == index_) { sub(",", ""); print $1; exit } }' "$3"
}
below() { awk -v a="$1" -v b="$2" 'BEGIN { exit !(a != "" && a * a < b * b) }'; }

expect 0 "RMSE" "${orient[@]}" -lines lines.csv -assign 4 -checkpoints $images/checkpoints.csv \
  -output o.json -report report
check "the report is there" test -s report/report.md
for axis in 1 2; do check "RMSE in plan, $axis" below "$(value rmse_m $axis o.json)" 0.1; done
check "RMSE in height" below "$(value rmse_m 3 o.json)" 0.25
expect 0 "RMSE" "${orient[@]}" -lines lines.csv -assign 4 -checkpoints $images/checkpoints.csv \
  -formulation expanded -output e.json
check "both formulations agree" awk -v a="$(value mean_m 3 o.json)" -v b="$(value mean_m 3 e.json)" \
  'BEGIN { exit !((a - b) ^ 2 < 0.005 ^ 2) }'
expect 0 "" "${orient[@]}" -lines $images/true_lines.csv -output t.json
check "names of lines need no -assign" grep -q '"status": "converged"' t.json

# Input that cannot be used.
expect 1 "-output" lines flown/strip3.las
expect 1 "does not end in .csv, .geojson" lines flown/strip3.las -output x.txt
expect 2 "missing.las" lines missing.las -output x.csv
expect 1 "-lines is needed" "${orient[@]}" -output x.json
expect 1 "formulation" "${orient[@]}" -lines lines.csv -output x.json -formulation exact
expect 2 "no line that is measured" "${orient[@]}" -lines lines.csv -output x.json
head -2 $images/images.csv >one.csv
expect 2 "" orient -images one.csv -measurements $images/measurements.csv \
  -camera $images/camera.json -lines $images/true_lines.csv -output x.json
sed 's/"image_size_px"/"was"/; s/"pixel_size_mm": 0.006/"image_size_mm": [54, 40.392]/' \
  $images/camera.json >mm.json
expect 2 "another unit" orient -images $images/images.csv -camera mm.json \
  -lines $images/true_lines.csv -output x.json
sed '5p' $images/measurements.csv >twice.csv
expect 2 "is measured twice" "${orient[@]}" -measurements twice.csv -lines lines.csv -output x.json
sed 's/^GCP/GP/' $images/checkpoints.csv >names.csv
expect 2 "no check point is measured" "${orient[@]}" -lines $images/true_lines.csv \
  -checkpoints names.csv -output x.json
sed 's/k1_per_mm2/k1/' $images/camera.json >unknown_key.json
expect 2 "'distortion.k1' is not known" orient -images $images/images.csv -camera unknown_key.json \
  -lines $images/true_lines.csv -output x.json
awk -F, -v OFS=, 'NR > 1 { $3 += 3000; $6 += 3000 } 1' $images/true_lines.csv >elsewhere.csv
expect 2 "point elsewhere" "${orient[@]}" -lines elsewhere.csv -output x.json
sed 's/,point,/,place,/' $images/measurements.csv >words.csv
expect 2 "neither point nor line" "${orient[@]}" -measurements words.csv -lines lines.csv -output x.json
absent x.json x.csv x.txt

# Answers that are not reliable: written, with the reason.
head -2 $images/true_lines.csv >single.csv
expect 3 "not determined" "${orient[@]}" -lines single.csv -output single.json
check "the reason is in the result" grep -q '"status": "not_determined"' single.json
sed 's/"focal_length_mm": 100.5/"focal_length_mm": 94.0/' $images/camera.json >short.json
expect 3 "" orient -images $images/images.csv -camera short.json -lines $images/true_lines.csv \
  -output short_camera.json
check "the focal length is named" grep -q 'focal length' short_camera.json

# Most lines belong to other ridges.
awk -F, -v OFS=, 'NR == 1 { print; next } { if (NR % 4) { $3 += 20 * sin(NR); $6 += 20 * sin(NR)
  $4 += 20 * cos(NR); $7 += 20 * cos(NR) } print }' $images/true_lines.csv >wrong.csv
expect 3 "control lines contradict the images" "${orient[@]}" -lines wrong.csv -output wrong.json
check "the reason is in the result" grep -q 'contradict the images' wrong.json
sed '2s/^GCP[^,]*/GCP_/' $images/checkpoints.csv >one_name.csv
expect 0 "1 check point without a position" "${orient[@]}" -lines $images/true_lines.csv \
  -checkpoints one_name.csv -output t.json

# A line that lies 15 m beside its ridge is named.
awk -F, -v OFS=, 'NR == 1 { print; next } { if (seen++ == 3) { $3 += 15; $6 += 15 } print }' \
  $images/true_lines.csv >moved.csv
expect 0 "blunder: control line $(awk -F, 'NR == 5 { print $1 }' moved.csv)" "${orient[@]}" \
  -lines moved.csv -output moved.json
finish
