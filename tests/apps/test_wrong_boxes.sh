#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# test_wrong_boxes.sh BIN_DIR SCRATCH_DIR: the bounding box in the header of a file changes no result,
# and every tool says that it is wrong.
source "$(dirname -- "${BASH_SOURCE[0]}")/tool_test.sh"
mkdir right wrong
cp "$block"/strip[12].las right
wrong() {  # CHANGE…: of the header of the first strip
  cp right/strip2.las wrong
  check "las_damage" "$damage" right/strip1.las wrong/strip1.las "$@"
}
same() {  # FILE…: of the folder right and of the folder wrong
  local file
  for file in "$@"; do check "$file is the same ($name)" cmp "right/$file" "wrong/$file"; done
}
remark="strip1.las: the header's bounding box is wrong: it says"
flight=(-trajectory "$block/trajectory.csv")

results() {  # FOLDER TEXT: what the tools make of the strips there
  expect 0 "${2#strip1.las: }" apply "$1/strip1.las" "$1/applied.las" "${flight[@]}" -bias boresight_roll=100 \
    -uncertainty_raster "$1/uncertainty.tif" -uncertainty_cell 5
  expect 0 "$2" convert "$1/strip1.las" "$1/strip1.pcd"
  expect 0 "$2" convert "$1/strip1.las" "$1/strip1.laz"
  expect 0 "$2" icpatch "$1/strip1.las" "$1/strip2.las" -output "$1/icpatch.json"
  expect 0 "$2" classify "$1"/strip[12].las -training "$block/training.csv" -cell 2 \
    -output "$1/cover.tif" -grids "$1/grids.tif"
  expect 0 "${2#strip1.las: }" info "$1/strip1.las" -output "$1/info.json"
  grep -v 'header_m\|path\|bounding box' "$1/info.json" | tr -d ' \n' |
    sed 's/"header_m[a-z]*":\[[^]]*\]//g' >"$1/info.txt"
  sed 's/right\|wrong//g' "$1/icpatch.json" >"$1/icpatch.txt"
}

name=right
results right ""
for name in zero half huge; do
  case $name in
    zero) wrong set min_x 0 set max_x 0 set min_y 0 set max_y 0 ;;
    half) wrong set max_y 5659975 ;;
    huge) wrong set min_x -1e300 set max_x 1e300 set min_y -1e300 set max_y 1e300 ;;
  esac
  results wrong "$remark"
  same applied.las uncertainty.tif strip1.pcd strip1.laz icpatch.txt cover.tif grids.tif
done
finish
