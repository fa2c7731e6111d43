#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# Numbers that are none, or that no option can mean: every numeric option of every tool ends with
# status 1 and one line that names the option, before any work is done.
source "$(dirname -- "$0")/tool_test.sh"

one=$block/strip1.las two=$block/strip2.las flight=$block/trajectory.csv
printf 'id,x1,y1,x2,y2,height\n1,0,0,1000,0,700\n2,1000,200,0,200,700\n' >lines.csv

# refused OPTION VALUE VERB ARG…
refused() {
  local option=$1 value=$2 verb=$3
  checks=$((checks + 1))
  status=0
  timeout 20 "$bin/pcl_als_$verb" "${@:4}" "-$option" "$value" >out.txt 2>err.txt </dev/null || status=$?
  [[ $status == 1 && $(wc -l <err.txt) == 1 && $(<err.txt) == *"$option"* ]] ||
    failed "pcl_als_$verb -$option '$value': status $status"
}

# Texts that are no number are refused by one function for all options: every option meets three of
# them, in turn, and every number that is outside its own range.
no_numbers=(inf -inf 1e309 0x10 5abc '' '1 2' 1,5)
turn=0
# numbers "OPTION…" VERB ARG…: options of one number each.
numbers() {
  local option value
  for option in $1; do
    for value in nan 1e30; do refused "$option" "$value" "${@:2}"; done
    [[ " $signed " == *" $option "* ]] || refused "$option" -1 "${@:2}"
    for value in 1 2 3; do refused "$option" "${no_numbers[turn++ % ${#no_numbers[@]}]}" "${@:2}"; done
  done
}

# part OPTION TEMPLATE VERB ARG…: a number in the middle of a text, in place of @.
part() {
  local value
  for value in nan inf 1e309 0x10 5abc 1e30 '1 2'; do
    refused "$1" "${2/@/$value}" "${@:3}"
  done
}

signed="temperature azimuth elevation"
estimation="range_noise angle_noise beam_divergence position_sigma roll_pitch_sigma heading_sigma
  control_sigma"
strips=("$one" "$two")
for tool in "$bin"/pcl_als_*; do numbers threads "${tool##*/pcl_als_}" "$one"; done
numbers "gps_week line_fit" apply "$one" x.las -trajectory "$flight" -bias range_bias=0.1
part bias range_bias=@ apply "$one" x.las -trajectory "$flight"
numbers "gps_week line_fit max_distance points candidates select $estimation" \
  calibrate "${strips[@]}" -trajectory "$flight" -output x.json
numbers "gps_week line_fit quality_level control_sigma max_distance cell points" \
  check "${strips[@]}" -trajectory "$flight" -output x.json
classify=(classify "${strips[@]}" -training "$block/training.csv" -output x.tif)
numbers "cell reject training_radius surface_gap terrain_gap largest_object texture_window tile" \
  "${classify[@]}"
part bounds 0,0,@,9 "${classify[@]}"
part priors tree=@ "${classify[@]}"
part ground_classes 2,@ "${classify[@]}"
numbers "max_distance determined_std points_per_strip candidates iterations" icpatch "${strips[@]}" -output x.json
numbers "length area angle point_noise same_distance strip_sigma" lines "$one" -output x.csv
if [[ -x $bin/pcl_als_orient ]]; then
  numbers "assign image_sigma" orient -images x -lines x -camera x -output x.json
fi
numbers "cell resolution" info "$one"
part bounds 0,0,@,9 info "$one"
part bounds 0,0,@,9 check "${strips[@]}" -output x.json
part bounds 0,0,@,9 calibrate "${strips[@]}" -trajectory "$flight" -output x.json
part bounds 0,0,@,9 convert "$one" x.las
numbers resolution convert "$one" x.las
intensity=(intensity "$one" x.las -trajectory "$flight")
numbers "gps_week line_fit reference_range range_exponent incidence_exponent largest_incidence
  visibility temperature pressure humidity wavelength attenuation saturation surface_radius
  surface_tolerance beam_divergence cell target_radius intensity_scale" "${intensity[@]}"
part strip_gains 1=@ "${intensity[@]}"
part pulse_rates 1=@ "${intensity[@]}"
numbers "fov speed pulse_density ground_slope slope sloped usable control $estimation" plan -lines lines.csv
numbers spacing plan -lines lines.csv
numbers "scale density seed fov relief buildings trees gain range_exponent incidence_exponent
  visibility height sessions" simulate -preset small -output x
part error time_offset=@ simulate -preset small -output x
part bias range_bias=@ simulate -preset small -output x
part origin 0,@,0 simulate -preset small -output x
part strip_gains 1=@ simulate -preset small -output x
if [[ -x $bin/pcl_als_view ]]; then
  numbers "cell azimuth elevation zoom point_size" view "$one" -output x.png
  part size 1600x@ view "$one" -output x.png
  part color_range 0:@ view "$one" -output x.png
  part bounds 0,0,@,9 view "$one" -output x.png
  profile=(profile "${strips[@]}" -output x.png)
  numbers auto "${profile[@]}"
  numbers width "${profile[@]}" -from 0,0 -to 9,9
  part from 0,@ "${profile[@]}" -to 9,9
  part to @,0 "${profile[@]}" -from 0,0
  part size @x900 "${profile[@]}" -auto 1
fi
absent x.las x.json x.tif x.png x
finish
