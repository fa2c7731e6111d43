#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# land_cover.sh BLOCK_DIR OUT_DIR [BIN_DIR]: what calibration and radiometric correction are worth for
# land cover (Habib et al. 2011). The same sites train a classification of the strips as delivered and
# one of the calibrated and corrected strips; both are checked at the same points.
#
# BLOCK_DIR  strip*.las, trajectory.csv, control.csv, training.csv, checkpoints.csv
#            (pcl_als_simulate makes such a block)
# BIN_DIR    where the tools are (default: they are found by PATH)
# Environment: CELL side of the cells, m (default 1); EXTENT west,south,east,north (default: all);
#   WEATHER options of pcl_als_intensity (default: those of the paper's flight);
#   BANDS that classes are told by (default: height,intensity, about those of the paper)
set -euo pipefail
export LC_ALL=C
(($# >= 2)) || { sed -n '5,16s/^# \{0,1\}//p' "$0"; exit 1; }
block=$1 out=$2
[[ $# -lt 3 ]] || PATH=$(cd -- "$3" && pwd):$PATH
cell=${CELL:-1} bands=${BANDS:-height,intensity}
read -ra weather <<<"${WEATHER:--visibility 48.3 -temperature 29.8 -pressure 101.81 -wavelength 1064}"
extent=()
[[ -z ${EXTENT:-} ]] || extent=(-bounds "$EXTENT")
mkdir -p -- "$out/calibrated"
strips=("$block"/strip*.las)

# A calibration that leaves a parameter out ends with 3 and says which; what it found is used.
echo "== 1 Calibrating"
status=0
pcl_als_calibrate "${strips[@]}" -trajectory "$block/trajectory.csv" -control "$block/control.csv" \
  -output "$out/calibration.json" || status=$?
[[ $status == 0 || $status == 3 ]] || exit "$status"

echo "== 2 Taking the biases out"
calibrated=()
for strip in "${strips[@]}"; do
  calibrated+=("$out/calibrated/$(basename -- "$strip")")
  pcl_als_apply "$strip" "${calibrated[-1]}" -trajectory "$block/trajectory.csv" \
    -calibration "$out/calibration.json"
done

echo "== 3 Correcting the intensities for range, incidence and atmosphere"
pcl_als_intensity "${calibrated[@]}" -corrected "$out/corrected" \
  -trajectory "$block/trajectory.csv" "${weather[@]}"

# One extent for both, so that their maps can be laid over each other.
echo "== 4 Classifying the strips as delivered, then the corrected ones"
common=(-training "$block/training.csv" -checkpoints "$block/checkpoints.csv" -cell "$cell"
        -bands "$bands" "${extent[@]}")
pcl_als_classify "${strips[@]}" "${common[@]}" -output "$out/before.tif" \
  -accuracy "$out/before.json" -checked "$out/before.csv"
pcl_als_classify "$out"/corrected/strip*.las "${common[@]}" -output "$out/after.tif" \
  -accuracy "$out/after.json" -checked "$out/after.csv" -grids "$out/grids.tif" \
  -save_class_model "$out/classes.json" -beside "$out/before.tif" -map "$out/land_cover.png" \
  -captions "as delivered,calibrated and corrected"

echo "== 5 Comparing them at the check points"
pcl_als_accuracy "$out/after.csv" -compare "$out/before.csv" -output "$out/comparison.json"
echo
echo "Maps side by side: $out/land_cover.png"
