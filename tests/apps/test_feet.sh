#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# The simulated block in metres and a copy of it in US survey feet, each point at the same place:
# every tool gives the same figures for both, and what it writes keeps the unit of its input.
source "$(dirname -- "$0")/tool_test.sh"
mkdir metre feet
for name in 1 2 3; do
  cp "$block/strip$name.las" metre/
  check "a copy in feet" "$bin/las_in_feet" "$block/strip$name.las" "feet/strip$name.las" 32611
done
cp "$block"/{trajectory,control,training,checkpoints}.csv metre/
cp metre/*.csv feet/

both() {  # TEXT VERB ARG…: the tool ends well in both folders; in feet it says TEXT
  (cd metre && "$bin/pcl_als_$2" "${@:3}" >out.txt 2>err.txt </dev/null) || failed "metres: $2"
  cd feet || exit 1
  expect 0 "$@"
  cd ..
}

# tokens FILE: words and numbers, one to a line; without what differs between any two runs.
tokens() {
  grep -vE '_ms"|seconds"|memory|"crs"|"units"' "$1" |
    grep -oE '"[^"]*"|-?[0-9]+(\.[0-9]+)?([eE][-+]?[0-9]+)?'
}
# same FILE TOLERANCE: words are equal, numbers to TOLERANCE, relative where they exceed 1.
same() {
  checks=$((checks + 1))
  paste -d '\n' <(tokens "metre/$1") <(tokens "feet/$1") | awk -v tolerance="$2" '
    NR % 2 { a = $0; next }
    a == $0 { next }
    { size = a < 0 ? -a : a; if (size < 1) size = 1; d = a - $0; if (d < 0) d = -d }
    a !~ /^"/ && $0 !~ /^"/ && d <= tolerance * size { next }
    { print a " in metres, " $0 " in feet"; bad = 1 }
    END { exit bad }' >out.txt 2>err.txt || failed "$1 differs"
  [[ -s metre/$1 ]] || failed "$1 is empty"
}
# points FILE: its records, without header and VLRs.
points() { tail -c +$(($(od -An -tu4 -j96 -N4 "$1") + 1)) "$1"; }
# records FILE MOST: of the files in both units at most MOST bytes of records differ. Where a
# correction ends half-way between two steps, rounding of the last digit decides.
records() {
  checks=$((checks + 1))
  cmp -l <(points "metre/$1") <(points "feet/$1") >out.txt 2>err.txt
  [[ $(wc -l <out.txt) -le $2 && ! -s err.txt ]] || failed "records of $1 differ"
}

both "US survey foot (GeoTIFF key 3076" info strip1.las
check "the extent is that in metres" test "$(grep -E 'extent|resolution' metre/out.txt)" = \
  "$(grep -E 'extent|resolution' feet/out.txt)"

# 1e-6: coordinates of the two files differ by rounding, 1e-9 m, which iterations amplify.
both "are brought to metres" check strip1.las strip2.las strip3.las -control control.csv -output quality.json
same quality.json 1e-6
both "are brought to metres" calibrate strip1.las strip2.las strip3.las -trajectory trajectory.csv \
  -control control.csv -output calibration.json -corrected corrected
same calibration.json 1e-6
records corrected/strip2.las 12

both "are brought to metres" apply strip1.las zero.las -trajectory trajectory.csv -bias range_bias=0
check "zero biases change no byte" cmp feet/strip1.las feet/zero.las
both "" apply strip1.las out.las -trajectory trajectory.csv -bias boresight_roll=90,range_bias=0.1
records out.las 12
both "" apply out.las back.las -trajectory trajectory.csv -bias boresight_roll=90,range_bias=0.1 -invert
check "the output states its unit" test "$(head -c 227 feet/out.las | tail -c 96 | head -c 48 | od -An -tx1)" = \
  "$(head -c 227 feet/strip1.las | tail -c 96 | head -c 48 | od -An -tx1)"

both "are brought to metres" icpatch strip1.las strip2.las -output pair.json -transformed moved.las
same pair.json 1e-6
records moved.las 100
both "are brought to metres" intensity strip1.las intensity.las -trajectory trajectory.csv
records intensity.las 100

both "are brought to metres" classify strip1.las strip2.las strip3.las -training training.csv \
  -checkpoints checkpoints.csv -cell 2 -output cover.tif -accuracy accuracy.json -classified classes
same accuracy.json 0.01
records classes/strip1.las 100
if [[ -x $bin/pcl_als_view ]]; then
  both "are brought to metres" view strip1.las -output view.png -title t
  check "one picture" cmp metre/view.png feet/view.png
fi

# Mixed units belong together where the CRS is one; a file that states nothing does not.
cp metre/strip1.las mixed1.las && cp feet/strip2.las mixed2.las
expect 0 "are brought to metres" icpatch mixed1.las mixed2.las -output mixed.json
check "a pair in two units" test "$(grep -A1 '"XT"' mixed.json)" = "$(grep -A1 '"XT"' metre/pair.json)"
check "a file without CRS" "$damage" metre/strip1.las silent.las set vlr_record 9
expect 2 "states no unit of length" icpatch silent.las feet/strip2.las -output x.json
absent x.json

# Files of coordinates are metres unless an option says otherwise.
awk -F, -v OFS=, 'NR > 1 { for (i = 2; i <= NF; i++) $i = sprintf("%.9f", $i * 39.37 / 12) } { print }' \
  metre/control.csv >feet/control_ft.csv
cd feet || exit 1
expect 0 "" check strip1.las strip2.las strip3.las -control control_ft.csv -control_units us_ft -output quality_ft.json
expect 1 "-control_units: 'feet' is none of" check strip1.las strip2.las -control control.csv -control_units feet -output x.json
cd .. && cp metre/quality.json metre/quality_ft.json
same quality_ft.json 1e-6
expect 1 "option -crs: 'EPSG:999999' is not known to PROJ" apply metre/strip1.las x.las \
  -trajectory metre/trajectory.csv -bias range_bias=0 -crs EPSG:999999
expect 1 "option -crs: 'EPSG:4326'" simulate -output none -crs EPSG:4326
expect 1 "option -crs: 'nonsense'" classify metre/strip1.las -training metre/training.csv -cell 2 -output x.tif -crs nonsense
absent x.las x.tif x.json none
finish
