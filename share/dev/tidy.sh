#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# share/dev/tidy.sh [REGEX]: clang-tidy on the sources whose path matches (default: all modules and
# tools), e.g. share/dev/tidy.sh modules/io. Needs clang-tidy 14.
source "$(dirname -- "${BASH_SOURCE[0]}")/../packages.sh"
# In a build folder of its own, for clang refuses GCC's precompiled headers, and sources are read one
# by one.
pcl_als_build=${PCL_ALS_BUILD_DIR:-$pcl_als_root/build-tidy}
pcl_als_configure -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -DPCL_ALS_UNITY_BUILD=OFF
run-clang-tidy-14 -quiet -j "$(nproc)" -p "$pcl_als_build" "${1:-$pcl_als_root/(modules|apps)/.*}"
