#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# Times in seconds of the week, adjusted standard GPS time (LAS 1.4) and offset GPS time (LAS 1.5) meet a trajectory in
# seconds of the week with the same results: corrected coordinates, intensities and calibrations.
source "$(dirname -- "$0")/tool_test.sh"

run simulate -output week -preset small -scale 0.4 -density 0.15 -noise realistic -seed 5
run simulate -output adjusted -preset small -scale 0.4 -density 0.15 -noise realistic -seed 5 -time adjusted
for offset in 1000 1250 1500; do
  run convert adjusted/strip*.las "offset$offset" -las_version 1.5 -time_offset $offset
done
run convert week/strip*.las week15 -format laz -las_version 1.5
forms=(week adjusted offset1000 offset1250 offset1500 week15)
expect 0 "LAS 1.5, point format 6*stored with an offset of 1500 million s" info offset1500/strip1.las
expect 0 "LAZ 1.5, point format 6*seconds of the GPS week" info week15/strip1.laz
expect 2 "its times are seconds of the GPS week; an offset needs absolute times" \
  convert week/strip1.las wrong.las -las_version 1.5 -time_offset 1500
absent wrong.las
expect 1 "option -time_offset*-las_version" convert week/strip1.las wrong.las -time_offset 1500
expect 1 "convert them first" convert week/strip1.las wrong.las -las_version 1.5 -bounds 0,0,1,1
expect 1 "has no version of LAS" convert week/strip1.las wrong.pcd -las_version 1.5
run convert offset1000/strip1.las back.las -las_version 1.4
cmp back.las adjusted/strip1.las || failed "LAS 1.4 to 1.5 and back changes bytes"

biases=boresight_roll=90,range_bias=-0.1,scan_angle_scale=1e-4
for form in "${forms[@]}"; do
  file=$(ls $form/strip1.la?)
  run apply "$file" "$form.las" -trajectory week/trajectory.csv -bias $biases
  run intensity "$file" "$form.intensity.las" -trajectory week/trajectory.csv
  run calibrate $form/strip*.la? -trajectory week/trajectory.csv -control week/control.csv -output "$form.json"
done
python3 - "${forms[@]}" <<'COMPARE' || failed "results depend on how times are counted"
import json, struct, sys

def records(path):
    """X, Y, Z and intensity of every point, LAS 1.4 or later."""
    data = open(path, "rb").read()
    start, length = struct.unpack_from("<I", data, 96)[0], struct.unpack_from("<H", data, 105)[0]
    count = struct.unpack_from("<Q", data, 247)[0]
    return [struct.unpack_from("<iiiH", data, start + i * length) for i in range(count)]

first, *others = sys.argv[1:]
failed = False
for kind in (".las", ".intensity.las"):
    expected = records(first + kind)
    for form in others:
        found = records(form + kind)
        # Times near 1e9 s have steps of 1e-7 s: a rounding may fall to the other side.
        largest = max(abs(a - b) for p, q in zip(expected, found) for a, b in zip(p, q))
        if len(found) != len(expected) or largest > 1:
            print(form + kind, len(found), len(expected), largest)
            failed = True
parameters = json.load(open(first + ".json"))["instrument"]["parameters"]
for form in others:
    for name, value in json.load(open(form + ".json"))["instrument"]["parameters"].items():
        same = parameters[name]
        if value["status"] != same["status"]:
            print(form, name, value["status"], same["status"])
            failed = True
        elif value.get("std") and abs(value["bias"] - same["bias"]) > 0.05 * same["std"]:
            print(form, name, value["bias"], same["bias"], same["std"])
            failed = True
sys.exit(failed)
COMPARE
finish
