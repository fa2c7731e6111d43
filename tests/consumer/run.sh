#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# run.sh BUILD_DIR SCRATCH_DIR BLOCK_DIR: installs the build, moves it to another place (with a blank
# in its name), and there configures, builds and runs the projects of users.
set -euo pipefail
export LC_ALL=C
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
build=$1 scratch=$2 block=$3
root=$(cd -- "$here/../.." && pwd -P)
rm -rf -- "$scratch" && mkdir -p -- "$scratch" && cd -- "$scratch"

cmake --install "$build" --prefix "$scratch/first" >install.log
# Folders of Debian's packages are only in these packages.
[[ $(ls first/share/doc) == pcl_als ]] || { echo "installed folders of documentation: $(ls first/share/doc)"; exit 1; }
mv first "moved prefix"
prefix="$scratch/moved prefix"
if grep -rlF -e "$root/" -e "$build/" -e "$scratch/first" "$prefix" --include='*.cmake' --include='*.h' --include='*.hpp'; then
  echo "an installed file names the build, the sources or the first prefix"
  exit 1
fi

# The C++ and CMake lines of the pages are those that are compiled here.
sample() {  # PAGE KIND N: the lines of the Nth block of this kind
  awk -v kind="\`\`\`$2" -v wanted="$3" '$0 == kind { on = ++count == wanted; next } $0 == "```" { on = 0 } on' "$root/$1"
}
same() {  # PAGE KIND N FILE: the block has the lines of the standard input, which are those of FILE
  diff <(sample "$1" "$2" "$3") - || { echo "$1 and tests/consumer/$4 differ"; exit 1; }
}
body() {  # FILE: what is inside of main()
  sed -n '/^int main() {$/,/^}$/p' "$1" | sed '1d;$d;s/^  //'
}
program=share/doc/programs.md
body "$here/project/readme.cpp" | same README.md cpp 1 project/readme.cpp
sed '1,4d' "$here/agreement/agreement.cpp" | same $program cpp 1 agreement/agreement.cpp
sed '1,4d' "$here/project/readme.cpp" | same $program cpp 2 project/readme.cpp
sed -n '/^  \/\/ programs.md$/,/^  \/\/ end$/p' "$here/project/clouds.cpp" | sed '1d;$d;s/^  //' |
  same $program cpp 3 project/clouds.cpp
sed '1d' "$here/agreement/CMakeLists.txt" | same $program cmake 1 agreement/CMakeLists.txt

flags=()
[[ -z ${SANITIZE:-} ]] || flags=(-DCMAKE_CXX_FLAGS="-fsanitize=$SANITIZE")
for project in "$here/project" "$here/agreement" "$root/share/examples/pipeline" "$root/share/examples/jobs"; do
  name=$(basename -- "$project")
  cmake -S "$project" -B "$name" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$prefix" \
    "${flags[@]}" >"$name.log" 2>&1 || { cat "$name.log"; exit 1; }
  cmake --build "$name"
done

./project/defined_by_source && ./project/defined_by_target
./project/consumer "$block/strip1.las" "$block/trajectory.csv"
"$prefix/bin/pcl_als_calibrate" "$block"/strip*.las -trajectory "$block/trajectory.csv" \
  -control "$block/control.csv" -output calibration.json -quiet || [[ $? == 3 ]]
./pipeline/pipeline "$block/trajectory.csv" "$block/control.csv" pipeline.json a.pcd "$block"/strip*.las
grep -aq '^FIELDS x y z .*gps_time' a.pcd
"$prefix/bin/pcl_als_info" a.pcd

# The jobs of share/examples/jobs against the truth of the block, and against the tools.
mkdir quasi && awk -F, 'NR == 1 { print "time,x,y,z" } NR > 1 { print $1","$2","$3","$4 }' \
  "$block/trajectory.csv" >quasi/positions.csv
jobs/calibrate quasi/positions.csv "$block/control.csv" quasi/calibration.json "$block"/strip*.las >quasi/calibration.txt
jobs/calibrate "$block/trajectory.csv" "$block/control.csv" jobs.json "$block"/strip*.las >jobs.txt || [[ $? == 3 ]]
cmp <("$here/stable.sh" jobs.json) <("$here/stable.sh" calibration.json)
# Biases that were put in, arc-seconds; four standard deviations of the block are below 4".
for table in jobs.txt quasi/calibration.txt; do
  roll=$(awk -F '|' '$2 ~ /^ *boresight_roll / { print $3 + 0; exit }' "$table")
  awk -v roll="$roll" 'BEGIN { exit !(roll > -94 && roll < -86) }' ||
    { echo "$table is not the truth"; cat "$table"; exit 1; }
done
# With and without attitude in the trajectory: as the tool corrects the strips, byte by byte.
correct() {  # TRAJECTORY CALIBRATION FOLDER
  mkdir -p "$3" && jobs/correct "$1" "$2" "$3" "$block"/strip*.las
  for strip in "$block"/strip*.las; do
    "$prefix/bin/pcl_als_apply" "$strip" applied.las -trajectory "$1" -calibration "$2" -quiet
    cmp applied.las "$3/$(basename -- "$strip")"
  done
}
correct "$block/trajectory.csv" jobs.json corrected
correct quasi/positions.csv quasi/calibration.json quasi/corrected
# … and as the calibration itself does.
"$prefix/bin/pcl_als_calibrate" "$block"/strip*.las -trajectory quasi/positions.csv -control "$block/control.csv" \
  -output quasi/tool.json -corrected quasi/by_tool -quiet
for strip in "$block"/strip*.las; do
  cmp "quasi/by_tool/$(basename -- "$strip")" "quasi/corrected/$(basename -- "$strip")"
done
./agreement/agreement "$block"/strip[12].las | grep -q '^1 & 2: RMSDz 0\.'
jobs/check corrected/strip*.las >check.txt || [[ $? == 3 ]]
grep -q 'keep QL2' check.txt
jobs/register corrected/strip2.las corrected/strip1.las >shift.txt
awk '{ exit !(NF == 4 && $1^2 + $2^2 + $3^2 < 0.02^2) }' shift.txt || { cat shift.txt; exit 1; }
# The strips were simulated with equal gains; their standard deviations are below 0.0015.
mkdir radiometry && jobs/intensity "$block/trajectory.csv" radiometry "$block"/strip*.las >gains.txt
"$prefix/bin/pcl_als_intensity" "$block"/strip*.las -corrected by_tool -trajectory "$block/trajectory.csv" \
  -estimate strip_gains -visibility 48.3 -temperature 29.8 -pressure 101.81 -quiet
for strip in "$block"/strip*.las; do
  cmp "by_tool/$(basename -- "$strip")" "radiometry/$(basename -- "$strip")"
done
awk '{ exit !($2 > 0.994 && $2 < 1.006) }' gains.txt || { cat gains.txt; exit 1; }
jobs/classify "$block/training.csv" "$block/checkpoints.csv" map.tif "$block"/strip*.las >accuracy.txt
# 62.5 % of 600 check points at a sixth of a point per square metre.
awk '{ exit !($3 > 0.58 && $3 <= 0.68) }' accuracy.txt || { cat accuracy.txt; exit 1; }
"$prefix/bin/pcl_als_classify" "$block"/strip*.las -training "$block/training.csv" -output by_tool.tif -quiet
cmp map.tif by_tool.tif
if [[ -x jobs/draw ]]; then env -u DISPLAY jobs/draw drawn.png "$block"/strip*.las && test -s drawn.png; fi
# The same from clouds: the noise of the block is 2 cm.
if [[ -x jobs/clouds ]]; then
  "$prefix/bin/pcl_als_classify" "$block"/strip*.las -training "$block/training.csv" -output by_tool.tif \
    -save_class_model model.json -quiet
  env -u DISPLAY jobs/clouds "$block/trajectory.csv" "$block/control.csv" model.json cloud.png "$block"/strip*.las >clouds.txt
  test -s cloud.png
  awk '{ exit !($2 > 0.1 && $5 < 0.03 && $8 < 0.02) }' clouds.txt || { cat clouds.txt; exit 1; }
fi

ln -s "$block"/{strip1.las,strip2.las,trajectory.csv,control.csv} .
# From clouds as from the PCD files of the same points.
./project/clouds "$block"/strip*.las
"$prefix/bin/pcl_als_calibrate" cloud*.pcd -trajectory trajectory.csv -control control.csv \
  -output from_files.json -quiet || [[ $? == 3 ]]
cmp <("$here/stable.sh" from_clouds.json) <("$here/stable.sh" from_files.json)
./project/readme
test -s corrected1.pcd -a -s corrected2.pcd

if [[ -x project/drawing ]]; then
  mkdir drawn && env -u DISPLAY ./project/drawing drawn
  test -s drawn/squares.png -a -s drawn/report.html
fi
