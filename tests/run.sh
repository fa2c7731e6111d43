#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# tests/run.sh [ctest options]: installs what is missing (Debian), builds, and runs the tests. Without
# options, those with the labels install and slow are left to share/dev/check.sh, which runs them and
# further checks; with options, ctest selects by these alone (tests/run.sh -L install).
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
status=0
(($#)) || set -- -LE '^(install|slow)$'
# Tests that compile much have a longer limit of their own.
ctest --output-on-failure --timeout 900 -j "$(nproc)" "$@" </dev/null || status=$?
# Inside a program, a test that lacks something (real data, root) is skipped: say which.
skipped=$(awk '/^SKIPPED: / { print "  " $0 }
  /^\[  SKIPPED \] .*\([0-9]+ ms\)$/ { sub(/\..*/, "", $4); count[$4]++ }
  END { for (suite in count) print "  " suite ": " count[suite] }' Testing/Temporary/LastTest.log)
[[ -z $skipped ]] || printf 'Skipped cases:\n%s\n' "$skipped"
[[ $status == 0 ]] && echo "All tests passed." || echo "Tests failed: see above." >&2
exit "$status"
