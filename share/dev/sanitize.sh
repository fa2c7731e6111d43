#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# share/dev/sanitize.sh [SANITIZERS [ctest options]]: the test suite with address and undefined
# behaviour sanitizers (or others, e.g. thread), in a build folder of its own.
source "$(dirname -- "${BASH_SOURCE[0]}")/../packages.sh"
sanitizers=${1:-address,undefined}
pcl_als_build=${PCL_ALS_BUILD_DIR:-$pcl_als_root/build-${sanitizers//,/-}}
pcl_als_configure -DBUILD_TESTING=ON -DCMAKE_BUILD_TYPE=RelWithDebInfo "-DPCL_ALS_SANITIZE=$sanitizers"
cmake --build "$pcl_als_build"
cd -- "$pcl_als_build"
# PCL and VTK keep what they allocate once until the end.
export ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=print_stacktrace=1
ctest --output-on-failure --timeout 3600 "${@:2}"
