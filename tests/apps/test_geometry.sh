#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# Blocks that determine no or not all parameters: the result states so and gives no other estimates.
source "$(dirname -- "$0")/tool_test.sh"
trajectory=(-trajectory "$block/trajectory.csv")
parameter() { cmake -DJSON="$1" -DNAME="$2" -DKEY="$3" -P "$here/parameter.cmake" 2>&1; }

expect 2 "fewer than two strips" calibrate "$block/strip1.las" "${trajectory[@]}" -output x.json
expect 1 "pairs*3" calibrate "$block/strip1.las" "$block/strip2.las" "${trajectory[@]}" -output x.json -pairs 1:3
absent x.json

# Strips 50 km apart: nothing overlaps. Both blocks are flown at the same times; the second strip is
# taken of the other place, and so is its part of the trajectory.
"$bin/pcl_als_simulate" -output far -preset small -scale 0.3 -density 0.3 -origin 750000,5660000,1000 -quiet
(awk -F, 'NR == 1 || $1 < 401100' "$block/trajectory.csv"; awk -F, 'NR > 1 && $1 > 401100' far/trajectory.csv) >both.csv
expect 2 "overlap" calibrate "$block/strip1.las" far/strip2.las -trajectory both.csv -output x.json
absent x.json

# A plane tells the height of points, hardly their place. Either the answer is refused as a whole, or
# the lever arm, which moves points within the plane, is given no number, or one that says it is none: a deviation of
# more than 5 cm, and the true 0 within two of them.
vague() {
  awk -v bias="$(parameter flat.json "$1" bias)" -v std="$(parameter flat.json "$1" std)" \
    'BEGIN { exit !(std > 0.05 && bias < 2 * std && bias > -2 * std) }'
}
"$bin/pcl_als_simulate" -output flat -preset small -scale 0.2 -density 0.2 -relief 0 -buildings 0 -trees 0 \
  -noise range -quiet
run calibrate flat/strip*.las -trajectory flat/trajectory.csv -control flat/control.csv -output flat.json
for name in lever_arm_x lever_arm_y; do
  checks=$((checks + 1))
  [[ $status == 3 && $(<err.txt) == "pcl_als_calibrate: "* ]] ||
    [[ $status == 0 && $(parameter flat.json $name status) == not_estimable ]] ||
    { [[ $status == 0 ]] && vague $name; } ||
    failed "flat block: status $status, and $name is $(parameter flat.json $name status)"
done
check "the result is written all the same" test -s flat.json
finish
