#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# test_channels.sh BIN_DIR SCRATCH_DIR: the channels of a scanner as strips of their own. The second channel has a boresight
# roll of its own, which shows between the channels of a strip and is recovered where they are strips.
source "$(dirname -- "${BASH_SOURCE[0]}")/tool_test.sh"

run simulate -output cross -preset small -scale 0.8 -scanner cross -noise range -bias none \
  -error channel1:boresight_roll=120
[[ $status == 0 ]] || failed "simulate"
strips=(cross/strip3.las cross/strip4.las cross/strip5.las)
flight=(-trajectory cross/trajectory.csv)

# As one strip the channels are not compared with each other.
run check "${strips[@]}" "${flight[@]}" -output strips.json
check "pairs of strips" test "$(grep -c '"a":' strips.json)" = 3
run check "${strips[@]}" "${flight[@]}" -channels scanner_channel -output channels.json
checks=$((checks + 1))
for name in 3.ch0 3.ch1 4.ch0 4.ch1 5.ch0 5.ch1; do
  grep -q "\"$name\"" channels.json || failed "channels.json has no strip $name"
done
check "every two channels are compared" test "$(grep -c '"a":' channels.json)" = 15

expect 2 "no field 'beam'" check "${strips[@]}" -channels beam -output x.json
run calibrate "${strips[@]}" "${flight[@]}" -channels scanner_channel -output c.json
checks=$((checks + 1))
grep -q '"3.ch1"' c.json || failed "c.json has no strip 3.ch1: status $status"

# More than four channels are in the user data; the scanner channel is 0 for all of them.
run simulate -output multi -preset small -scale 0.3 -density 0.5 -scanner multi:6 -noise range
run check multi/strip3.las multi/strip4.las -channels scanner_channel -output one.json
check "one channel" test "$(grep -c '"a":' one.json)" = 1
run check multi/strip3.las multi/strip4.las -channels user_data -output six.json
checks=$((checks + 1))
grep -q '"4.ch5"' six.json || failed "six.json has no strip 4.ch5"
finish
