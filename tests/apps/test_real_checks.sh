#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# test_real_checks.sh BIN_DIR SCRATCH_DIR DATA_DIR: pcl_als_check on real deliveries beside values measured otherwise.
# Skipped (status 77) without the data.
data=${PCL_ALS_TEST_DATA:-$3}
source "$(dirname -- "${BASH_SOURCE[0]}")/tool_test.sh"
[[ -d $data/real/bcts ]] || { echo "real test data is absent: $data"; exit 77; }


# Ground that a filter found in all strips together: with and without the classes the same, near the offsets of plain
# ground in 1 m cells (the data's README). What is compared is other ground: the strips tilt, so 1 cm is allowed.
for packed in "$data"/real/bcts/*.las.xz; do xz -dc "$packed" >"$(basename -- "$packed" .xz)"; done
for tile in 1 2 3 4; do "$damage" bcts_$tile.las plain_$tile.las class 1; done
expect 0 '3 of 3 pairs keep QL2' check bcts_?.las -output classes.json -report classes
expect 0 '3 of 3 pairs keep QL2' check plain_?.las -output plain.json -report plain
while read -r a b offset; do
  found=$(cell classes "$a" "$b" vertical_mean_m) plain=$(cell plain "$a" "$b" vertical_mean_m)
  std=$(cell plain "$a" "$b" vertical_mean_std_m) checks=$((checks + 2))
  near "${found:-9}" "$offset" 0.01 || failed "bcts: $a is $found above $b, measured $offset"
  near "${found:-9}" "${plain:-8}" "$std" || failed "bcts: $a is $found above $b, without classes $plain"
done <<'OFFSETS'
66 67 -0.040
66 68 -0.020
67 68 0.020
OFFSETS
rm -f plain_?.las bcts_?.las
finish
