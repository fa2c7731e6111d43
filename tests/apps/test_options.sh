#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# Help, version and wrong usage of every tool.
source "$(dirname -- "$0")/tool_test.sh"

for tool in "$bin"/pcl_als_*; do
  verb=${tool##*/pcl_als_}
  for help in -h -help --help; do
    expect 0 "Usage: pcl_als_$verb*Options (one dash or two):*--threads*Example:*Exit status:" "$verb" $help
  done
  for version in -version --version; do expect 0 "pcl_als_$verb [0-9]*.[0-9]*.[0-9]" "$verb" $version; done
  expect 1 "bogus" "$verb" -bogus 1
  expect 1 "bogus" "$verb" --bogus=1
  expect 1 "threads" "$verb" -threads
  expect 1 "threads" "$verb" -threads many
  expect 1 "threads" "$verb" -threads -2
done

for tool in apply calibrate info; do expect 1 "usage: pcl_als_$tool" "$tool"; done
expect 1 "output" simulate
expect 1 "preset" simulate -output x -preset huge
expect 1 "scale" simulate -output x -scale 0
expect 1 "scale" simulate -output x -scale nan
expect 1 "noise" simulate -output x -noise loud
expect 1 "boresight_rol" simulate -output x -bias boresight_rol=3
expect 1 "usage" simulate -output x a.las
absent x
strip=$block/strip1.las
expect 1 "trajectory" apply "$strip" x.las -biases range_bias=0.1
expect 1 "biases" apply "$strip" x.las -trajectory "$block/trajectory.csv"
expect 1 "range_bia" apply "$strip" x.las -trajectory "$block/trajectory.csv" -biases range_bia=0.1
expect 1 "range_bias" apply "$strip" x.las -trajectory "$block/trajectory.csv" -biases range_bias=1e9
expect 1 "usage" apply "$strip" x.las y.las -trajectory "$block/trajectory.csv" -biases range_bias=0.1
absent x.las y.las
two=("$block/strip1.las" "$block/strip2.las" -trajectory "$block/trajectory.csv")
expect 1 "output" calibrate "${two[@]}"
expect 1 "trajectory" calibrate "$block/strip1.las" "$block/strip2.las" -output x.json
expect 1 "wobble" calibrate "${two[@]}" -output x.json -estimate boresight_roll,wobble
expect 1 "pairs" calibrate "${two[@]}" -output x.json -pairs 1-2
expect 1 "model" calibrate "${two[@]}" -output x.json -model perfect
absent x.json
finish
