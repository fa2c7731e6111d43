#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# test_pulse_waves.sh BIN_DIR SCRATCH_DIR: PulseWaves files in the tools.
source "$(dirname -- "${BASH_SOURCE[0]}")/tool_test.sh"

"$bin/pulse_waves" in.pls
expect 0 "PulseWaves 0.3, 200 pulses*scanner 1: Scanner X*returning: segments of samples of 16 bits*waveforms in in.wvs" \
  info in.pls
expect 0 "334 echoes of 200 pulses" waveform in.pls out.laz
expect 0 "334 points" info out.laz
expect 0 "334 echoes" waveform in.pls plain.las -pulse_width 4.8 -threads 2
expect 0 "" waveform in.pls shown.las -output waveform.json -waveforms 17
check "the waveform of a pulse" grep -q '"number": 17,' waveform.json
expect 0 "waveforms.png" plot waveform.json -output plots
expect 1 "in.pls: has no pulse 200, the numbers are 0 to 199" waveform in.pls x.laz -output x.json -waveforms 200
cp in.pls copy.pls && cp in.wvs copy.wvs
expect 0 "copy.pls" info copy.pls out.laz

# What has to be refused.
expect 1 "pulses and no returns" waveform in.pls x.laz -only_returns
expect 1 "pulses and no returns" waveform in.pls x.laz -move_returns
expect 1 "-output lists points" info in.pls -output x.json
expect 2 "in.pls: has pulses, not points; pcl_als_waveform writes their echoes as points" convert in.pls x.laz
cp in.pls in.plz
expect 2 "in.plz: compressed pulses cannot be read; decompress them to .pls and .wvs" waveform in.plz x.laz
expect 2 "in.plz: compressed pulses" info in.plz
head -c 9000 in.pls >copy.pls
expect 2 "copy.pls: its header states 200 pulses, and the file has room for * it is truncated" waveform copy.pls x.laz
head -c 300 in.pls >copy.pls
expect 2 "copy.pls: has 300 bytes" waveform copy.pls x.laz
cp in.pls copy.pls && head -c 5000 in.wvs >copy.wvs
expect 2 "copy.pls: pulse *: its waves at byte * reach past the end of copy.wvs" waveform copy.pls x.laz
mv copy.wvs copy.wvz
expect 2 "copy.wvz: compressed waves cannot be read; decompress them to copy.wvs" waveform copy.pls x.laz
rm copy.wvz
expect 2 "copy.pls: its waves are in copy.wvs, which is missing beside it" waveform copy.pls x.laz
expect 0 "200 pulses*scanner 1*! copy.pls: its waves are in copy.wvs, which is missing beside it" info copy.pls
absent x.laz x.json
finish
