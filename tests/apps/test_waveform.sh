#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# test_waveform.sh BIN_DIR SCRATCH_DIR: pcl_als_waveform as a user runs it, and tools that rewrite files with waveforms:
# every output can be decomposed as the input can.
source "$(dirname -- "${BASH_SOURCE[0]}")/tool_test.sh"

# echoes FILE WHAT: its waveforms give all echoes of the points, and as many new ones as in WHAT.
echoes() {
  rm -f echoes.las echoes.wdp
  expect 0 "$2" waveform "$1" echoes.las -pulse_width 4.8
}

for format in 4 9; do
  "$bin/las_waveforms" "$format" made.las
  expect 0 "" convert made.las in.las  # with the box of its points
  all="200 of returns, 40 new points; 0 returns without an echo"
  echoes in.las "$all"
  check "the waveforms are beside the output" cmp in.wdp echoes.wdp
  expect 0 "waveform descriptor 1: 80 samples of 16 bits, 1000 ps apart" info echoes.las
  expect 0 "waveforms in in.wdp" info in.las
  expect 0 "4.7" waveform in.las estimated.laz -threads 2

  # LAS to LAZ to LAS, a part, and strips.
  expect 0 "" convert in.las packed.laz
  echoes packed.laz "$all"
  expect 0 "" convert packed.laz back.las
  check "LAS to LAZ to LAS gives the same bytes" cmp in.las back.las
  check "and the same waveforms" cmp in.wdp back.wdp
  expect 0 "" convert in.las part.las -bounds -100,-100,1.30,100
  check "a part has its waveforms" cmp in.wdp part.wdp
  run waveform part.las echoes_of_part.las -pulse_width 4.8
  checks=$((checks + 1))
  [[ $status == 0 && $(<out.txt) == *" 0 returns without an echo"* ]] || failed "echoes of a part"
  rm -rf strips
  expect 0 "" convert in.las strips -split
  for strip in strips/*.las; do
    check "waveforms of $strip" cmp in.wdp "${strip%.las}.wdp"
  done
  # With echoes of its own as input: fields get other names.
  expect 0 "" waveform echoes.las twice.las -pulse_width 4.8
  rm -f -- *.las *.laz *.wdp
done

"$bin/las_waveforms" 4 made.las
expect 0 "" convert made.las in.las
run waveform in.las only.las -pulse_width 4.8 -only_returns
checks=$((checks + 1))
[[ $status == 0 && $(<out.txt) == *"200 of returns, 0 new points"* ]] || failed "-only_returns"
awk 'BEGIN { print "time_ns,value"; for (t = -10; t <= 10; t += 0.5) print t "," exp(-t * t / 8.17) }' >pulse.csv
expect 0 "200 of returns, 40 new" waveform in.las sampled.las -pulse pulse.csv

# The result file, and pictures of waveforms: examples, and those of some points.
expect 0 "" waveform in.las shown.las -pulse_width 4.8 -output waveform.json
expect 0 "pulse.svg*waveforms.svg" plot waveform.json -output plots -format svg
check "residuals are drawn" grep -q "below: residuals" plots/waveforms.svg
check "echoes are counted" grep -q "point [0-9]*: 2 echoes, 1 new" plots/waveforms.svg
expect 0 "" waveform in.las shown.las -pulse_width 4.8 -output asked.json -waveforms 7,199
check "the waveforms that are asked for" test "$(grep -c '"number": \(7\|199\),' asked.json)" == 2
expect 1 "in.las: has no point 200, the numbers are 0 to 199" waveform in.las x.las -pulse_width 4.8 -output y.json -waveforms 200
expect 1 "option -waveforms: '-3' is no number of a point" waveform in.las x.las -output y.json -waveforms 1,-3
check "nothing is written" test ! -e y.json
sed 's/"amplitude": [0-9.]*/"amplitude": "large"/' waveform.json >damaged.json
expect 2 "damaged.json: 'waveforms[[]0].echoes[[]0].amplitude' must be a number" plot damaged.json -output plots
sed 's/"model": \[/"model": [1,/' waveform.json >damaged.json
expect 2 "damaged.json: 'waveforms[[]0].model' must have four values" plot damaged.json -output plots

# Cross sections: the sensor is 1000 m above the first sample along the pulse.
awk 'BEGIN { print "time,x,y,z"; for (i = -100; i <= 100; ++i)
  printf "%.2f,%.3f,%.3f,%.3f\n", 230038.25 + 0.1 * i, -287.348, 6 * i, 1457.826 }' >flight.csv
expect 0 "calibration constant 1, they are relative" waveform in.las relative.las -pulse_width 4.8 -trajectory flight.csv
printf 'x,y,reflectance,id\n1.3,0,0.3,asphalt\n' >targets.csv
whole="a whole pulse has the backscatter coefficient 1.1"
expect 0 "m2 / (count ns km4), relative std*$whole*40 echoes" waveform in.las sections.las -pulse_width 4.8 -trajectory flight.csv \
  -targets targets.csv -correct_attenuation
printf 'x,y,reflectance,id\n900,0,0.3,far\n' >far.csv
expect 2 "no reference target has" waveform in.las x.las -pulse_width 4.8 -trajectory flight.csv -targets far.csv
expect 1 "-trajectory" waveform in.las x.las -pulse_width 4.8 -targets targets.csv

# The energies of echoes in place of intensity.
expect 0 "intensities are the energies of echoes" intensity sections.las energies.las -trajectory flight.csv -echo_energy \
  -no_incidence -no_fields
expect 2 "in.las: has no extra field amplitude" intensity in.las x.las -trajectory flight.csv -echo_energy

# What has to be refused.
expect 1 "-pulse_width" waveform in.las x.las -pulse_width 0
expect 1 "-pulse" waveform in.las x.las -pulse_width 4 -pulse pulse.csv
expect 1 "in.las" waveform in.las in.las
expect 1 "" waveform in.las x.pcd
expect 1 "" waveform in.las
printf 'time_ns,value\n0,1\n1,2\n3,1\n4,0\n5,0\n' >uneven.csv
expect 2 "evenly spaced" waveform in.las x.las -pulse uneven.csv
printf 'time_ns,value\n0,0\n1,2\n' >short.csv
expect 2 "five samples" waveform in.las x.las -pulse short.csv
expect 2 "missing.las" waveform missing.las x.las
head -c 3000 in.wdp >cut.wdp && cp in.las cut.las
expect 2 "cut.las: point *: its waveform packet at byte * reaches past the end" \
  waveform cut.las x.las -pulse_width 4.8
rm cut.wdp
expect 2 "cut.las: its waveforms are in cut.wdp, which is missing" waveform cut.las x.las
absent x.las x.wdp
finish
