#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# test_lidar_hd.sh BIN_DIR SCRATCH_DIR: the tools on the real block of tests/data/lidar_hd, beside values that follow from
# the points by awk.
source "$(dirname -- "${BASH_SOURCE[0]}")/tool_test.sh"
tiles=("$here"/../data/lidar_hd/*.laz)

# ground FOLDER: medians over square metres with at least five ground points of each strip: height of 706 above 707, and the
# ratio of their intensities
ground() {
  awk '/^#/ { next } $1 == "x" { for (i = 1; i <= NF; i++) at[$i] = i; next }
    $at["classification"] == 2 && $at["number_of_returns"] == 1 {
      cell = int($at["x"]) " " int($at["y"]); strip = $at["point_source_id"]; cells[cell]
      count[strip, cell]++; height[strip, cell] += $at["z"]; intensity[strip, cell] += $at["intensity"]
    }
    END { for (cell in cells) { a = count[706, cell]; b = count[707, cell]; if (a < 5 || b < 5) continue
      print height[706, cell] / a - height[707, cell] / b, intensity[706, cell] / a / (intensity[707, cell] / b) } }' \
    "$1"/*.xyz >cells.txt
  for column in 1 2; do
    sort -g -k "$column,$column" cells.txt | awk -v column="$column" '{ v[NR] = $column } END { printf "%.4f ", v[int((NR + 1) / 2)] }'
  done
}

expect 0 '405 937 points*2 strips*706 *274 851*707 *131 086' info "${tiles[@]}"
expect 0 '' convert "${tiles[@]}" text -format xyz
read -r height ratio < <(ground text)

# Height: ground by its class and all smooth surfaces without it differ by some millimetres.
expect 0 '1 of 1 pairs keep QL' check "${tiles[@]}" -output quality.json -report report
found=$(cell report 706 707 vertical_mean_m)
checks=$((checks + 1))
near "$found" "$height" 0.004 || failed "check: 706 is $found above 707, ground in square metres $height"

# The plan: what 707 is moved by is found.
expect 0 '' convert "${tiles[@]}" strips -split -format xyz
awk '/^#/ || $1 == "x" { print; next } { $1 = sprintf("%.3f", $1 + 0.30); $2 = sprintf("%.3f", $2 - 0.20)
  $3 = sprintf("%.3f", $3 + 0.10); print }' strips/707.xyz >moved.xyz
expect 0 '' convert strips/706.xyz 706.las
expect 0 '' convert strips/707.xyz 707.las
expect 0 '' convert moved.xyz moved.las
expect 0 '' icpatch 707.las 706.las -output first.json
expect 0 '' icpatch moved.las 706.las -output second.json
while read -r name shift; do
  before=$(number $name value first.json) after=$(number $name value second.json) std=$(number $name std first.json)
  checks=$((checks + 1))
  near "$(awk -v a="$before" -v b="$after" 'BEGIN { print a - b }')" "$shift" "$(awk -v s="$std" 'BEGIN { print 0.2 * s }')" ||
    failed "icpatch: $name is $before and after a shift by $shift $after, standard deviation $std"
done <<'SHIFTS'
XT 0.30
YT -0.20
ZT 0.10
SHIFTS

# The trajectory comes from multiple returns alone: the angles at which it sees the points are those that the scanner recorded.
expect 0 '' trajectory "${tiles[@]}" -output trajectory.csv
while read -r strip recorded; do
  seen=$(awk -v strip="$strip" 'FILENAME == "trajectory.csv" { split($0, v, ","); if (v[1] + 0 > 0 && (v[1] > 306235000) == (strip == 706)) {
      n++; y += v[3]; z += v[4] } next }
    /^#/ || $1 == "x" { next } $7 == strip { m++; north += $2; up += $3 }
    END { print -atan2(y / n - north / m > 0 ? y / n - north / m : north / m - y / n, z / n - up / m) * 45 / atan2(1, 1) }' \
    trajectory.csv text/*.xyz)
  checks=$((checks + 1))
  near "$seen" "$recorded" 1 || failed "trajectory: strip $strip is seen at $seen degrees, recorded $recorded"
done < <(awk '/^#/ || $1 == "x" { next } { n[$7]++; sum[$7] += $6 } END { for (s in n) print s, sum[s] / n[s] }' text/*.xyz)

# The same ground is a third brighter seen from above; the correction removes most of it.
expect 0 '' intensity "${tiles[@]}" -trajectory trajectory.csv -corrected corrected
expect 0 '' convert corrected/*.laz corrected_text -format xyz
read -r _ corrected < <(ground corrected_text)
check "intensity: ratio of the strips $ratio, corrected $corrected" awk -v a="$ratio" -v b="$corrected" \
  'BEGIN { exit !(b > 0 && log(b)^2 < 0.25 * log(a)^2) }'
finish
