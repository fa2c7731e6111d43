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
mv first "moved prefix"
prefix="$scratch/moved prefix"
if grep -rlF -e "$root/" -e "$build/" -e "$scratch/first" "$prefix" --include='*.cmake' --include='*.h' --include='*.hpp'; then
  echo "an installed file names the build, the sources or the first prefix"
  exit 1
fi

# The README's lines of C++ are those that are compiled here.
diff <(sed -n '/^```cpp$/,/^```$/p' "$root/README.md" | grep -v '^```') <(sed '1,4d' "$here/project/readme.cpp") ||
  { echo "README.md and tests/consumer/project/readme.cpp differ"; exit 1; }

flags=()
[[ -z ${SANITIZE:-} ]] || flags=(-DCMAKE_CXX_FLAGS="-fsanitize=$SANITIZE")
for project in "$here/project" "$root/share/examples/pipeline"; do
  name=$(basename -- "$project")
  cmake -S "$project" -B "$name" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$prefix" \
    "${flags[@]}" >"$name.log" 2>&1 || { cat "$name.log"; exit 1; }
  cmake --build "$name"
done

./project/consumer "$block/strip1.las" "$block/trajectory.csv"
"$prefix/bin/pcl_als_calibrate" "$block"/strip*.las -trajectory "$block/trajectory.csv" \
  -control "$block/control.csv" -output calibration.json -quiet || [[ $? == 3 ]]
./pipeline/pipeline "$block/strip1.las" "$block/strip2.las" "$block/trajectory.csv" calibration.json a.pcd
grep -aq '^FIELDS x y z .*gps_time' a.pcd
"$prefix/bin/pcl_als_info" a.pcd

ln -s "$block"/{strip1.las,strip2.las,trajectory.csv} .
./project/readme
test -s corrected1.pcd -a -s corrected2.pcd

if [[ -x project/drawing ]]; then
  mkdir drawn && env -u DISPLAY ./project/drawing drawn
  test -s drawn/squares.png -a -s drawn/report.html
fi
