#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# pcl_als_icpatch as a user runs it: a pair, the moved source, and what it must refuse.
source "$(dirname -- "$0")/tool_test.sh"
a=$block/strip1.las b=$block/strip2.las

expect 0 "centroid" icpatch "$a" "$b" -output r.json -transformed moved.las
check "the result says converged" grep -q '"status": "converged"' r.json
for name in XT YT ZT omega phi kappa; do
  check "$name has a standard deviation" near "$(number $name std r.json)" 0.05 0.05
done
expect 0 "" icpatch moved.las "$b" -output again.json
for name in XT YT ZT; do  # steps of 1 mm, and where the iteration stops
  check "the moved strip stays ($name)" near "$(number $name value again.json)" 0 0.001
done
check "the start is elsewhere" test "$(number ZT value r.json)" != "$(number ZT value again.json)"
# The head has a VLR more, which records the motion.
points_of() { tail -c +$(($(od -An -tu4 -j96 -N4 "$1") + 1)) "$1"; }
points_of "$a" >source.bin
points_of moved.las >moved.bin
check "the moved file has the points of the source" test "$(stat -c %s moved.bin)" = "$(stat -c %s source.bin)"
check "times and all other fields are kept" test "$(cmp -l source.bin moved.bin | awk -v size="$(od -An -tu2 -j105 -N2 "$a")" '($1 - 1) % size >= 12' | wc -l)" = 0
expect 0 "corrected*the points were moved" info moved.las
expect 0 "" icpatch "$b" "$a" -output back.json
for name in XT YT ZT; do
  check "forward and backward agree ($name)" near "$(number $name value r.json)" \
    "$(awk -v v="$(number $name value back.json)" 'BEGIN { print -v }')" 0.001
done
expect 0 "" icpatch "$a" "$b" -pair 1:2 -output pair.json
[[ $(<out.txt) != *"same points"* ]] || failed "files of both strips are taken for copies of themselves"
check "strips by their ids give the same" near "$(number XT value pair.json)" \
  "$(number XT value r.json)" 0.001
expect 0 "" icpatch "$a" "$a" -output same.json
check "a strip lies on itself" near "$(number XT value same.json)" 0 0.00001

expect 1 "-output" icpatch "$a" "$b"
expect 1 "" icpatch "$a" -output x.json
expect 1 "-pair" icpatch "$a" "$b" -pair 1 -output x.json
expect 1 "-pair" icpatch "$a" "$b" -pair 1:x -output x.json
expect 1 "-transformed" icpatch "$a" "$b" -pair 1:2 -output x.json -transformed x.las
expect 1 "max_distance" icpatch "$a" "$b" -output x.json -max_distance -1
expect 1 "one kind" icpatch "$a" "$b" -output x.json -transformed x.pcd
expect 1 "is also an input" icpatch "$a" "$b" -output x.json -transformed "$a"
expect 1 "unknown" icpatch "$a" "$b" -output x.json -unknown 3
expect 2 "missing.las" icpatch missing.las "$b" -output x.json
expect 2 "strip 77" icpatch "$a" "$b" -pair 77:2 -output x.json
expect 2 "nowhere" icpatch "$a" "$b" -output nowhere/x.json
head -c 200 "$a" >cut.las; expect 2 "cut.las" icpatch cut.las "$b" -output x.json
"$bin/pcl_als_simulate" -quiet -output far -preset small -scale 0.1 -density 0.1 \
  -origin 710000,5660000,1000
expect 2 "do not overlap" icpatch "$a" far/strip1.las -output x.json
absent x.json x.las

# A plane determines heights and tilts alone: written, and said.
"$bin/pcl_als_simulate" -quiet -output flat -preset small -scale 0.3 -density 0.3 -noise range \
  -relief 0 -buildings 0 -trees 0 -bias none
expect 3 "XT is not determined" icpatch flat/strip1.las flat/strip2.las -output flat.json
check "the result of the plane is there" grep -q not_determined flat.json
check "and its height" near "$(number ZT value flat.json)" 0 0.01
finish
