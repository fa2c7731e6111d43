#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# test_reduced_build.sh BIN_DIR SCRATCH_DIR SOURCE_DIR: the tools without PROJ, VTK, GDAL and Ceres are
# built and linked, do their work, and say what they cannot do.
# The build folder is beside that of BIN_DIR and has its options of compilation, so that ccache
# provides all objects but those of the few sources that differ.
set -euo pipefail
main=$(dirname -- "$1")
build=${main}_reduced
type=$(sed -n 's/^CMAKE_BUILD_TYPE:[A-Z]*=//p' "$main/CMakeCache.txt")
mkdir -p -- "$build"
trap 'rm -rf -- "$build"' EXIT
cmake -S "$3" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE="$type" -DBUILD_TESTING=OFF \
  -DPCL_ALS_WITH_PROJ=OFF -DPCL_ALS_WITH_VTK=OFF -DPCL_ALS_WITH_GDAL=OFF -DPCL_ALS_WITH_CERES=OFF \
  -DPCL_ALS_WITH_PYTHON=OFF >"$build/configure.log" 2>&1 ||
  { cat "$build/configure.log"; exit 1; }
cmake --build "$build" --target pcl_als_tools >"$build/build.log" 2>&1 ||
  { tail -n 40 "$build/build.log"; exit 1; }

set -- "$build/bin" "$2"
source "$(dirname -- "${BASH_SOURCE[0]}")/tool_test.sh"
strips=("$block"/strip[12].las)
trajectory=$block/trajectory.csv

for tool in "$bin"/pcl_als_*; do
  verb=${tool##*/pcl_als_}
  expect 0 'Usage' "$verb" -h
done
check "no pcl_als_orient" test ! -e "$bin/pcl_als_orient"

# Reports and pictures are those of a complete build, windows are not.
run calibrate "${strips[@]}" -trajectory "$trajectory" -output calibration.json -report report
check 'calibrate ends with 0 or 3' test "$status" = 0 -o "$status" = 3
check 'the calibration is there' test -s calibration.json -a -s report/report.md
check 'the page of the calibration' grep -q '<svg ' report/report.html
expect 0 'without GDAL: no swath separation image' check "${strips[@]}" -output quality.json -report quality
check 'tables of the check' test -s quality/quality.md
check 'the page of the check' grep -q '<svg ' quality/report.html
expect 0 'shown' view "${strips[@]}" -output top.png
expect 1 'built without VTK' view "${strips[@]}" -window
expect 1 'built without GDAL' check "${strips[@]}" -output layers.json -gis layers.gpkg
absent layers.json layers.gpkg

# What needs the missing libraries is refused.
head -c 1360 /dev/zero >flight.sbet
expect 2 'PROJ' apply "$block/strip1.las" out.las -trajectory flight.sbet -calibration calibration.json
expect 2 'GDAL' classify "${strips[@]}" -training "$block/training.csv" -cell 2 -output map.tif
absent out.las map.tif
finish
