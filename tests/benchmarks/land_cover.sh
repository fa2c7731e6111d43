#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# land_cover.sh BIN_DIR SCRATCH_DIR [SEEDS [simulation options]]: the whole chain of
# share/examples/land_cover on simulated blocks of several seeds; one line per seed: overall accuracy
# and kappa of the strips as delivered and of the calibrated and corrected ones, and how sure the
# differences are.
set -euo pipefail
export LC_ALL=C
bin=$1 scratch=$2 seeds=${3:-"1 2 3 4 5"}
shift $(($# < 3 ? $# : 3))
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
mkdir -p -- "$scratch"
value() {  # FILE KEY: the first number after the key
  awk -v key="\"$2\"" 'index($0, key) { at = 1 }
    at && match($0, /: *-?[0-9][0-9.eE+-]*/) { print substr($0, RSTART + 1); exit }' "$1"
}
echo "| seed | overall %, raw | corrected | difference | kappa, raw | corrected | difference | +- | p | McNemar p |"
echo "|---|---|---|---|---|---|---|---|---|---|"
for seed in $seeds; do
  block=$scratch/block$seed out=$scratch/cover$seed
  rm -rf -- "$block" "$out"
  "$bin/pcl_als_simulate" -output "$block" -preset small -noise realistic -seed "$seed" -quiet "$@"
  "$here/../../share/examples/land_cover/land_cover.sh" "$block" "$out" "$bin" >"$scratch/seed$seed.log"
  json=$out/comparison.json
  awk -v seed="$seed" -v a1="$(value "$out/after.json" overall_accuracy)" \
    -v a0="$(value "$out/before.json" overall_accuracy)" -v k1="$(value "$out/after.json" kappa)" \
    -v k0="$(value "$out/before.json" kappa)" -v std="$(value "$json" kappa_difference_std)" \
    -v p="$(value "$json" p_two_sided)" -v m="$(value "$json" p_exact)" 'BEGIN {
      printf "| %d | %.1f | %.1f | %+.1f | %.3f | %.3f | %+.3f | %.3f | %.1g | %.1g |\n", seed,
        100 * a0, 100 * a1, 100 * (a1 - a0), k0, k1, k1 - k0, std, p, m }'
done
