#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# tests/run.sh [ctest options]: installs what is missing (Debian), builds, runs the whole test suite.
#   PCL_ALS_BUILD_DIR  build folder (default: build/ in the sources)
#   PCL_ALS_TEST_DATA  real data (default: ../shared/data beside the sources); without it the tests
#                      that need it are skipped, by name
source "$(dirname -- "${BASH_SOURCE[0]}")/../share/packages.sh"

pcl_als_step "Installing what is missing"
pcl_als_install build test
pcl_als_step "Configuring in $pcl_als_build"
pcl_als_configure -DBUILD_TESTING=ON
pcl_als_step "Building"
cmake --build "$pcl_als_build"
pcl_als_step "Testing"
cd -- "$pcl_als_build"
ctest --output-on-failure --timeout 900 -j "$(nproc)" "$@" </dev/null
