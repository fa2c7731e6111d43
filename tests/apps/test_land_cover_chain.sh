#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# test_land_cover_chain.sh BIN_DIR SCRATCH_DIR: share/examples/land_cover as a user runs it; correcting
# the intensities of two flying heights must be worth more than in the paper.
source "$(dirname -- "${BASH_SOURCE[0]}")/tool_test.sh"
[[ -x $bin/pcl_als_intensity ]] || { echo "SKIPPED: pcl_als_intensity is not built"; exit 77; }
check "the chain" env CELL=2 "$here/../../share/examples/land_cover/land_cover.sh" "$block" out "$bin"
for file in calibration.json corrected/strip1.las before.tif after.tif grids.tif classes.json \
            land_cover.png comparison.json; do
  check "$file is there" test -s "out/$file"
done
value() {  # KEY: the first number after the key in comparison.json
  awk -v key="\"$1\"" 'index($0, key) { at = 1 }
    at && match($0, /: *-?[0-9][0-9.eE+-]*/) { print substr($0, RSTART + 1); exit }' out/comparison.json
}
# Habib et al. 2011: 7.5 points and 0.116.
check "the overall accuracy rises" awk -v d="$(value overall_difference)" 'BEGIN { exit !(d + 0 > 0.075) }'
check "kappa rises" awk -v d="$(value kappa_difference)" 'BEGIN { exit !(d + 0 > 0.116) }'
check "significantly" awk -v p="$(value p_two_sided)" 'BEGIN { exit !(p != "" && p + 0 < 0.01) }'
check "McNemar agrees" awk -v p="$(value p_exact)" 'BEGIN { exit !(p != "" && p + 0 < 0.01) }'
finish
