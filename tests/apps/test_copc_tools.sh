#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# COPC files in the tools: -bounds and -resolution give what the same window of the whole file gives.
source "$(dirname -- "$0")/tool_test.sh"

mkdir copc plain
for strip in 1 2 3 4; do
  check "a COPC file of strip $strip" "$bin/las_to_copc" "$block/strip$strip.las" "copc/$strip.copc.laz"
  # The same points in the same order without an octree; strips are named by source id.
  expect 0 "points" convert "copc/$strip.copc.laz" "plain/$strip.las"
done
expect 0 "COPC" info copc/1.copc.laz
expect 0 "point format 6" info plain/1.las
check "no octree is left" sh -c "! '$bin/pcl_als_info' plain/1.las | grep -qi copc"

# A window in the middle of the block, where strips overlap.
read -r x y < <("$bin/pcl_als_info" plain/*.las -output all.json | awk '/^  extent/ {
  gsub(",", ""); if (!n++ || $3 > w) w = $3; if (n == 1 || $5 < e) e = $5
  if (n == 1 || $7 > s) s = $7; if (n == 1 || $9 < t) t = $9 }
  END { printf "%.0f %.0f\n", (w + e) / 2, (s + t) / 2 }')
bounds=$((x - 60)),$((y - 60)),$((x + 60)),$((y + 60))

same() {  # WHAT FILE FILE: equal except for the names, format and VLRs of the point files
  checks=$((checks + 1))
  for each in "$2" "$3"; do
    sed -E '/"vlrs": \[$/,/^ *\],?$/d; /"vlrs"/d; s/(copc|plain)\/([1-4])\.(copc\.laz|las)/\2/g
      s/, COPC//; s/LA[SZ] 1/LA 1/' "$each" >"$each.names"
  done
  cmp "$2.names" "$3.names" || failed "$1"
}
for kind in copc plain; do
  expect 0 "a part of the files was read" info $kind/* -bounds "$bounds" -output $kind.info.json
  expect 0 "" view $kind/* -bounds "$bounds" -output $kind.png -bare
  expect 0 "" profile $kind/* -bounds "$bounds" -from "$((x - 40)),$y" -to "$((x + 40)),$y" \
    -output $kind.profile.png -title t
  run check $kind/* -bounds "$bounds" -output $kind.quality.json
  run calibrate $kind/* -bounds "$bounds" -trajectory "$block/trajectory.csv" -output $kind.calibration.json
done
same "info of a window" copc.info.json plain.info.json
check "view of a window" cmp copc.png plain.png
check "profile of a window" cmp copc.profile.png plain.profile.png
same "check of a window" copc.quality.json plain.quality.json
same "calibration of a window" copc.calibration.json plain.calibration.json
check "the calibration has numbers" grep -q '"pairs"' copc.calibration.json
# Parameters of a part correct whole files; errors of strips are known within the part only.
calibrate=(calibrate plain/* -bounds "$bounds" -trajectory "$block/trajectory.csv" -output part.json -corrected all)
run "${calibrate[@]}" -force -quiet
points() { "$bin/pcl_als_info" "$1" | awk '$1 == "points"'; }
check "corrected copies have all points" test "$(points all/1.las)" = "$(points plain/1.las)"
check "all of them are moved" test "$(cmp -l all/1.las plain/1.las | wc -l)" -gt "$(($(stat -c %s plain/1.las) / 60))"
expect 1 "-strip_corrections and -bounds exclude each other" "${calibrate[@]}" -strip_corrections
expect 1 "-corrected and -keep_readable exclude each other" "${calibrate[@]}" -keep_readable

# Conversion of the window, and levels of the octree.
expect 0 "points" convert copc/1.copc.laz window.laz -bounds "$bounds"
expect 0 "points" convert plain/1.las window.las -bounds "$bounds"
expect 0 "points" convert window.laz window_again.las
check "one window" cmp <(tail -c +376 window.las) <(tail -c +376 window_again.las)
expect 0 "50 m apart" info copc/1.copc.laz -resolution 50
expect 0 "points" convert copc/1.copc.laz coarse.laz -resolution 50
check "fewer points" test "$(stat -c %s coarse.laz)" -lt "$(stat -c %s copc/1.copc.laz)"
expect 2 "plain/1.las: is no COPC file" info plain/1.las -resolution 5
expect 2 "plain/1.las: is no COPC file" check plain/* -resolution 5 -output none.json
expect 1 "-resolution" info copc/1.copc.laz -resolution 0
expect 2 "no point lies within the bounds; copc/1.copc.laz covers by its header x" info copc/1.copc.laz -bounds 0,0,1,1
expect 2 "no point lies within the bounds" view copc/1.copc.laz -bounds 0,0,1,1 -output none.png
expect 2 "no point lies within the bounds" check copc/* -bounds 0,0,1,1 -output none.json
expect 2 "no point lies within the bounds" calibrate copc/* -bounds 0,0,1,1 -output none.json \
  -trajectory "$block/trajectory.csv"
absent none.png none.json
finish
