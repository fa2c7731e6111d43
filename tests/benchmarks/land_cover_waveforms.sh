#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# land_cover_waveforms.sh BIN_DIR SCRATCH_DIR [SEEDS [simulation options]]: land cover from discrete
# returns and from decomposed waveforms of the same simulated blocks, without biases; one line per
# seed: check points that are wrong.
set -euo pipefail
export LC_ALL=C
bin=$1 scratch=$2 seeds=${3:-"1 2 3 4 5"}
shift $(($# < 3 ? $# : 3))
weather=(-visibility 48.3 -temperature 15 -pressure 101.325 -wavelength 1064)
default=height,intensity,roughness,multiple_returns
discrete=$default,echoes_per_pulse,height_std
mkdir -p -- "$scratch"
wrong() {  # BLOCK FOLDER BANDS: check points that are wrong
  "$bin/pcl_als_classify" "$1/$2"/strip*.las -training "$1/training.csv" \
    -checkpoints "$1/checkpoints.csv" -bands "$3" -output "$1/map.tif" \
    -accuracy "$1/accuracy.json" -quiet >/dev/null
  awk '/"points":/ { all = $2 + 0 } /"correct":/ && !found { found = 1; print all - $2 }' \
    "$1/accuracy.json"
}
echo "| seed | returns, default bands | returns, 6 bands | echoes, default bands | echoes, 6 bands | echoes, 7 bands |"
echo "|---|---|---|---|---|---|"
for seed in $seeds; do
  block=$scratch/waves$seed
  rm -rf -- "$block"
  "$bin/pcl_als_simulate" -output "$block" -preset small -noise realistic -bias none -waveforms \
    -seed "$seed" -quiet "$@"
  mkdir -p -- "$block/echoes"
  for strip in "$block"/strip*.las; do
    "$bin/pcl_als_waveform" "$strip" "$block/echoes/${strip##*/}" -move_returns -pulse_width 4 -quiet
  done
  "$bin/pcl_als_intensity" "$block"/echoes/strip*.las -corrected "$block/echoes_corrected" \
    -trajectory "$block/trajectory.csv" -echo_energy "${weather[@]}" -quiet
  "$bin/pcl_als_intensity" "$block"/strip*.las -corrected "$block/corrected" \
    -trajectory "$block/trajectory.csv" "${weather[@]}" -quiet
  echo "| $seed | $(wrong "$block" corrected "$default") | $(wrong "$block" corrected "$discrete") |" \
    "$(wrong "$block" echoes_corrected "$default") | $(wrong "$block" echoes_corrected "$discrete") |" \
    "$(wrong "$block" echoes_corrected "$discrete,echo_width") |"
done
