#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# make_block.sh BIN_DIR SCRATCH_DIR: the simulated block that the tests of the tools share.
set -euo pipefail
rm -rf -- "$2/block"
mkdir -p -- "$2"
"$1/pcl_als_simulate" -output "$2/block" -preset small -scale 0.3 -density 0.3 -noise range -seed 5
