#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# test_simulated_waveforms.sh BIN_DIR SCRATCH_DIR: pcl_als_simulate -waveforms as a user runs it: its files are read by
# pcl_als_info, decomposed by pcl_als_waveform and rewritten by pcl_als_convert.
source "$(dirname -- "${BASH_SOURCE[0]}")/tool_test.sh"

small=(-preset small -scale 0.3 -density 0.03 -bias none)

# decomposed FILE OUT OPTION…: all points have a waveform, and nearly all an echo.
decomposed() {
  run waveform "$1" "$2" "${@:3}"
  checks=$((checks + 1))
  [[ $status == 0 && $(<out.txt) == *" 0 without a waveform"* ]] || failed "decomposition of $1"
  # At most one return in 200 has no echo.
  checks=$((checks + 1))
  sed -E ':again; s/([0-9]) ([0-9])/\1\2/; t again' out.txt >counts.txt
  awk '/ echoes: / { for (i = 2; i <= NF; ++i) {
         if ($i == "of" && $(i + 1) == "returns,") found = $(i - 1)
         if ($i == "returns" && $(i + 1) == "without") lost = $(i - 1) } }
       END { exit !(found > 1000 && 200 * lost < found) }' counts.txt || failed "returns without echoes in $1"
}

for format in 4 5 9 10; do
  for packed in las laz; do
    run simulate -output block "${small[@]}" -waveforms -waveform_format $format -format $packed
    checks=$((checks + 1))
    [[ $status == 0 ]] || failed "simulate format $format as $packed"
    expect 0 "point format $format" info block/strip1.$packed
    expect 0 "waveform descriptor 1: 64 samples of 12 bits, 1000 ps apart" info block/strip1.$packed
    expect 0 "waveforms in strip1.wdp" info block/strip1.$packed
    [[ $format == 5 || $format == 10 ]] || decomposed block/strip1.$packed echoes.$packed
    if [[ $packed == las ]]; then
      mv block/strip1.wdp las.wdp
    else
      check "LAS and LAZ have the same waveforms" cmp block/strip1.wdp las.wdp
    fi
    rm -rf block echoes.*
  done
done

# Without the option nothing of waveforms is written.
run simulate -output plain "${small[@]}"
checks=$((checks + 1))
[[ $status == 0 ]] || failed "simulate without waveforms"
absent plain/strip1.wdp
check "no waveforms in truth.json" test "$(grep -c waveform plain/truth.json)" = 0

# Other pulses and digitizers. The width of a Gaussian pulse is found again.
run simulate -output narrow "${small[@]}" -waveforms -pulse_width 3 -sample_bits 8 -sample_spacing 0.5 -threads 1
check "spacing and bits" grep -q "64 samples of 8 bits, 500 ps apart" <("$bin/pcl_als_info" narrow/strip1.las)
decomposed narrow/strip1.las narrow_echoes.las
check "width of the pulse" grep -Eq "descriptor 1: pulse of (2\.9|3\.0)[0-9] ns" counts.txt
check "truth" grep -q '"bits": 8' narrow/truth.json
run simulate -output again "${small[@]}" -waveforms -pulse_width 3 -sample_bits 8 -sample_spacing 0.5 -threads 3
check "the same waveforms by three threads" cmp narrow/strip1.wdp again/strip1.wdp
expect 0 "Classifying by height, echo_width" classify narrow_echoes.las -training narrow/training.csv \
  -cell 5 -output cover.tif -bands height,echo_width
awk 'BEGIN { print "time_ns,value"; for (t = -10; t <= 10; t += 0.5) print t "," exp(-t * t / 8) * (1 + t / 12) }' >pulse.csv
run simulate -output sampled "${small[@]}" -waveforms -pulse pulse.csv -noise realistic
decomposed sampled/strip1.las sampled_echoes.las -pulse pulse.csv
run simulate -output skewed "${small[@]}" -waveforms -pulse_skewness 0.6
decomposed skewed/strip1.las skewed_echoes.las -pulse_output estimated.csv
check "the shape is estimated" grep -Eq "skewness 0\.[4-7][0-9], from the samples of" counts.txt
check "the maximum is at the time 0" awk -F, '$1 + 0 == 0 && $2 > 0.9999 && $2 < 1.0001 { top = 1 }
  $2 > 1.0001 { exit 1 } END { exit !top }' <(sed 1d estimated.csv)
cp counts.txt estimated.txt
decomposed skewed/strip1.las again_echoes.las -pulse estimated.csv
check "the pulse that was written is read" grep -q "as given" counts.txt
check "and is the one that was used" awk '/ echoes: / { n[++k] = $1 }
  END { exit !(k == 2 && (n[1] - n[2]) ^ 2 <= 4) }' estimated.txt counts.txt
expect 1 "-pulse_output" waveform skewed/strip1.las x.las -pulse_output pulse.txt

# Tools that rewrite the files keep their waveforms.
expect 0 "" convert narrow/strip1.las copy.laz
check "waveforms of a copy" cmp narrow/strip1.wdp copy.wdp

expect 1 "option -sample_bits needs -waveforms" simulate -output x "${small[@]}" -sample_bits 8
expect 1 "-sample_bits" simulate -output x "${small[@]}" -waveforms -sample_bits 17
expect 1 "-waveform_format" simulate -output x "${small[@]}" -waveforms -waveform_format 6
expect 1 "picoseconds" simulate -output x "${small[@]}" -waveforms -sample_spacing 0.30001
expect 1 "-pulse" simulate -output x "${small[@]}" -waveforms -pulse pulse.csv -pulse_width 4
finish
