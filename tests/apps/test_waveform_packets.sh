#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# test_waveform_packets.sh BIN_DIR SCRATCH_DIR: all point formats with waveforms, packets in the file and in a .wdp, LAS
# and LAZ: copies, parts, strips, corrections and decompositions keep the packets bit by bit, and the points refer to
# them.
source "$(dirname -- "${BASH_SOURCE[0]}")/tool_test.sh"

# same FILE WHAT: the packets of FILE are those of the input.
same() {
  local packets=${1%.*}.wdp
  if [[ $place == inside ]]; then
    absent "$packets"
    packets=extracted.wdp
    "$bin/las_packets" extract "$1" "$packets"
  fi
  check "format $format, packets $place: $2" cmp packets.wdp "$packets"
}

# decomposed FILE WHAT: all echoes of its points are found in its waveforms.
decomposed() {
  run waveform "$1" echoes.laz -pulse_width 4.8
  checks=$((checks + 1))
  [[ $status == 0 && $(<out.txt) == *" 0 returns without an echo, 0 without a waveform"* ]] ||
    failed "format $format, packets $place: decomposition of $2"
  same echoes.laz "$2, decomposed"
  rm -f echoes.*
}

awk 'BEGIN { print "time,x,y,z,roll,pitch,heading"; for (i = -100; i <= 100; ++i)
  printf "%.2f,%.3f,%.3f,%.3f,0.1,0.2,0\n", 230038.25 + 0.1 * i, -287.348, 6 * i, 1457.826 }' >flight.csv

for format in 4 5 9 10; do
  for place in beside inside; do
    "$bin/las_waveforms" "$format" made.las
    expect 0 "" convert made.las in.las  # with the box of its points
    cp in.wdp packets.wdp
    if [[ $place == inside ]]; then
      "$bin/las_packets" inside in.las in_file.las
      rm in.wdp
      mv in_file.las in.las
      expect 0 "waveforms in the file, 3" info in.las
    else
      expect 0 "waveforms in in.wdp" info in.las
    fi
    decomposed in.las "the input"
    expect 0 "" convert in.las packed.laz
    same packed.laz "LAS to LAZ"
    decomposed packed.laz "LAZ"
    expect 0 "" convert packed.laz back.las
    same back.las "LAZ to LAS"
    check "format $format, packets $place: LAS to LAZ to LAS" cmp in.las back.las
    for packed in las laz; do
      source=in.las
      [[ $packed == laz ]] && source=packed.laz
      expect 0 "" convert $source part.$packed -bounds -100,-100,1.30,100
      same part.$packed "part of $packed"
      decomposed part.$packed "a part of $packed"
      expect 0 "" convert $source strips -split
      for strip in strips/*; do
        [[ $strip == *.wdp ]] || same "$strip" "strip of $packed"
      done
      expect 0 "" apply $source applied.$packed -trajectory flight.csv -bias boresight_roll=30,range_bias=0.1
      same applied.$packed "correction of $packed"
      decomposed applied.$packed "corrected $packed"
      rm -rf strips part.* applied.*
    done
    rm -f -- *.las *.laz *.wdp
  done
done
finish
