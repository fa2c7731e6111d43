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

value_of() { awk -v s="\"$1\"" '/"source":/ { found = index($0, s) } found && /"value":/ { gsub(/[^-0-9.e]/, "", $2); print $2 }' "$2"; }
expect 2 "no field 'beam'" check "${strips[@]}" -channels beam -output x.json
expect 3 "channel1_boresight_roll: boresight roll of channel 1 against channel 0" \
  calibrate "${strips[@]}" "${flight[@]}" -channels scanner_channel -output c.json
check "roll of the second channel in the diagnosis" awk '/"source": "channel1_boresight_roll"/ { getline; getline
  gsub(/[^0-9.]/, "", $2); found = $2 > 0.9 } END { exit !found }' c.json
check "difference of the channels" awk -v v="$(value_of channel1_boresight_roll c.json)" 'BEGIN { exit !(v > 117 && v < 123) }'
checks=$((checks + 1))
grep -q '"3.ch1"' c.json || failed "c.json has no strip 3.ch1: status $status"

# Two systems: the second channel has its roll of 120" (four standard deviations; 1" where the noise is that of ranges),
# and the corrected strips of both channels fit each other. A calibration of one system leaves the difference.
expect 0 converged calibrate "${strips[@]}" "${flight[@]}" -channels scanner_channel -systems a=3-5:0 b=3-5:1 \
  -own boresight -output systems.json -corrected corrected
read -r first second < <(awk '/"boresight_roll"/ { getline; gsub(/[^-0-9.e]/, "", $2); printf "%s ", $2 }' systems.json |
  awk '{ print $2, $3 }')
check "roll of the first channel, $first" awk -v v="$first" 'BEGIN { exit !(v > -4 && v < 4) }'
check "roll of the second channel, $second" awk -v v="$second" 'BEGIN { exit !(v > 116 && v < 124) }'
# Not divided, the channels are compared within the strips all the same.
expect 3 "boresight roll of channel 1 against channel 0 differs by*and no parameters of one system" \
  calibrate "${strips[@]}" "${flight[@]}" -output one.json
cp out.txt one.txt
check "remedy" grep -q "differs by 1[12].*-channels scanner_channel divides them" one.txt
check "difference of the roll" awk -v v="$(value_of channel1_boresight_roll one.json)" 'BEGIN { exit !(v > 116 && v < 124) }'
expect 0 "" apply cross/strip3.las by_apply.las "${flight[@]}" -calibration systems.json
check "apply equals -corrected" cmp by_apply.las corrected/strip3.las
expect 0 "" check corrected/strip3.las "${flight[@]}" -channels scanner_channel -output after.json
rms() { awk -F': ' '/"vertical_rmsd_m"/ { gsub(/,/, "", $2); print $2; exit }' "$1"; }
run check cross/strip3.las "${flight[@]}" -channels scanner_channel -output before.json
check "misfit of channels, $(rms before.json) before, $(rms after.json) after" \
  awk -v b="$(rms before.json)" -v a="$(rms after.json)" 'BEGIN { exit !(a < 0.5 * b) }'
expect 2 "belong to none of the systems" apply cross/strip1.las none.las "${flight[@]}" -calibration systems.json
absent none.las
expect 1 "there is no strip 9.ch1" calibrate "${strips[@]}" "${flight[@]}" -channels scanner_channel \
  -systems a=3-5:0 b=9:1 -output no.json
expect 1 "NAME=STRIPS" calibrate "${strips[@]}" "${flight[@]}" -systems a -output no.json
absent no.json

# The scanners of a system as strips with ids of their own, 10 k and 10 k + 1, without the field of the channel.
for k in 3 4 5; do
  run convert cross/strip$k.las channels.ply -ascii
  awk 'body { $id = 10 * $id + int($flags / 64); $flags %= 64 }
    /^property/ { ++count; if ($3 == "point_source_id") id = count; if ($3 == "flags") flags = count }
    /^end_header/ { body = 1 } { print }' channels.ply >ids$k.ply
done
expect 3 "scanner2_boresight_roll: boresight roll of scanner 2 against scanner 1 differs by 1[12]" \
  calibrate ids[345].ply "${flight[@]}" -output one_ids.json
check "difference of the scanners" awk -v v="$(value_of scanner2_boresight_roll one_ids.json)" 'BEGIN { exit !(v > 117 && v < 123) }'
expect 0 converged calibrate ids[345].ply "${flight[@]}" -systems a=30,40,50 b=31,41,51 -own boresight -output ids.json
read -r first second < <(awk '/"boresight_roll"/ { getline; gsub(/[^-0-9.e]/, "", $2); printf "%s ", $2 }' ids.json |
  awk '{ print $2, $3 }')
check "roll of the first scanner, $first" awk -v v="$first" 'BEGIN { exit !(v > -4 && v < 4) }'
check "roll of the second scanner, $second" awk -v v="$second" 'BEGIN { exit !(v > 116 && v < 124) }'

# More than four channels are in the user data; the scanner channel is 0 for all of them.
run simulate -output multi -preset small -scale 0.3 -density 0.5 -scanner multi:6 -noise range
run check multi/strip3.las multi/strip4.las -channels scanner_channel -output one.json
expect 0 "" calibrate multi/strip*.las -trajectory multi/trajectory.csv -output multi.json
check "channels in the user data do not differ" test -z "$(awk '/"warnings"/,/\]/' multi.json | grep 'user data')"
check "channels in the user data are compared" test -n "$(value_of user_data5_boresight_roll multi.json)"
check "one channel" test "$(grep -c '"a":' one.json)" = 1
run check multi/strip3.las multi/strip4.las -channels user_data -output six.json
checks=$((checks + 1))
grep -q '"4.ch5"' six.json || failed "six.json has no strip 4.ch5"
finish
