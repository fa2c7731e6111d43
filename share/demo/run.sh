#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# share/demo/run.sh [OUT_DIR]: from a fresh Debian 12 to a calibrated block. Installs what is missing,
# builds the tools that it runs, simulates six strips over 1 km x 2 km, calibrates and corrects them,
# checks strips and control before and after, and shows all beside the truth. What is there is kept.
#   OUT_DIR            where the block and the results go (default: ./pcl_als_demo; about 1.2 GB)
#   PCL_ALS_BUILD_DIR  build folder (default: build/ in the sources)
#   PCL_ALS_DEMO_PRESET  the block: paper (default, 11 million points) or small (a tenth of that)
if [[ ${1:-} == -h || ${1:-} == --help || $# -gt 1 ]]; then
  sed -n '5,10s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"
  [[ $# -eq 1 ]]; exit
fi
source "$(dirname -- "${BASH_SOURCE[0]}")/../packages.sh"

demo=$pcl_als_root/share/demo
bin=$pcl_als_build/bin
mkdir -p -- "${1:-pcl_als_demo}"
out=$(cd -- "${1:-pcl_als_demo}" && pwd -P)
block=$out/block corrected=$out/corrected result=$out/calibration.json

# outdated RESULT INPUT…: RESULT is missing or older than an input.
outdated() {
  local result=$1 input
  shift
  [[ -e $result ]] || return 0
  for input in "$@"; do
    [[ ! $input -nt $result ]] || return 0
  done
  return 1
}

pcl_als_step "Installing what is missing"
pcl_als_install build

pcl_als_step "Building in $pcl_als_build"
pcl_als_configure
cmake --build "$pcl_als_build" \
  --target pcl_als_app_{simulate,calibrate,apply,view,profile,check}

pcl_als_step "Simulating the block"
if outdated "$block/truth.json" "$bin/pcl_als_simulate"; then
  "$bin/pcl_als_simulate" -output "$block" -preset "${PCL_ALS_DEMO_PRESET:-paper}" -noise range
else
  echo "$block is up to date"
fi
strips=("$block"/strip*.las)

pcl_als_step "Calibrating ${#strips[@]} strips"
status=0
if outdated "$result" "$bin/pcl_als_calibrate" "$block/truth.json"; then
  "$bin/pcl_als_calibrate" "${strips[@]}" -trajectory "$block/trajectory.csv" \
    -control "$block/control.csv" -output "$result" -report "$out/report" | tee "$out/calibration.txt" | sed '/^$/,$d' ||
    status=$?
  # 3: an answer that is written but not reliable; it is shown all the same.
  [[ $status == 0 || $status == 3 ]] || exit "$status"
else
  echo "$result is up to date"
fi

pcl_als_step "Correcting the strips"
mkdir -p -- "$corrected"
for strip in "${strips[@]}"; do
  target=$corrected/${strip##*/}
  if outdated "$target" "$bin/pcl_als_apply" "$result"; then
    "$bin/pcl_als_apply" "$strip" "$target" -trajectory "$block/trajectory.csv" \
      -calibration "$result" | grep '^Writing'
  else
    echo "$target is up to date"
  fi
done

pcl_als_step "Pictures"
pictures=$out/pictures
mkdir -p -- "$pictures"
if outdated "$pictures/profile1.png" "$bin/pcl_als_profile" "$corrected/strip1.las"; then
  "$bin/pcl_als_view" "${strips[@]}" -output "$pictures/elevation.png" -shade hill | grep '^Drawing'
  "$bin/pcl_als_view" "$block"/strip[12].las -color difference -reference_strip 1 \
    -output "$pictures/difference_before.png" -color_range=-0.5:0.5 | grep '^Drawing'
  "$bin/pcl_als_view" "$corrected"/strip[12].las -color difference -reference_strip 1 \
    -output "$pictures/difference_after.png" -color_range=-0.5:0.5 | grep '^Drawing'
  "$bin/pcl_als_profile" "${strips[@]}" -after "$corrected" -auto 3 -output "$pictures" | grep '^Drawing'
else
  echo "$pictures is up to date"
fi

pcl_als_step "Checking strips and control before and after"
if outdated "$out/quality.json" "$bin/pcl_als_check" "$corrected"/strip*.las; then
  "$bin/pcl_als_check" "$corrected"/strip*.las -before "$block" -control "$block/control.csv" \
    -output "$out/quality.json" -report "$out/quality" | sed '/^$/,$d' ||
    echo "The check gave no reliable answer."
else
  echo "$out/quality.json is up to date"
fi

pcl_als_step "Results"
cmake -DCALIBRATION="$result" -DTRUTH="$block/truth.json" -DOUTPUT="$out/summary.tsv" \
  -P "$demo/summary.cmake"
{
  awk -f "$demo/tables.awk" "$out/summary.tsv"
  # Of the check, the tables of heights, movements and control.
  awk 'BEGIN { RS = "" }
    /^(Height differences|Rigid movement|Heights of strips)/ { print "\n" $0 "\n"; getline; print }' \
    "$out/quality/quality.md"
} | tee "$out/summary.txt"
cat <<END

Look at:
  $out/report/report.html  verdict, tables, plots and map on one page (any browser)
  $pictures/  the block, two strips' differences and three roofs before and after
  $result  biases, uncertainty, correlations, fits; in words: calibration.txt
  $corrected/  the corrected strips (any LAS viewer)
  $out/quality/report.html  the same of the check before and after; tables and swath separation images beside it
  $out/quality.json  the check for programs
  $block/  the simulated strips, trajectory, control and truth
  $out/summary.txt  these tables
Tools are in $bin; each explains itself with -h.
END
exit "$status"
