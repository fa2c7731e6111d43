#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# share/dev/headers.sh [REGEX]: reads the sources whose path matches (default: all) one by one, without
# precompiled headers, and names those that do not include what they use.
source "$(dirname -- "${BASH_SOURCE[0]}")/../packages.sh"
commands=$pcl_als_root/share/dev/compile_commands.awk
pcl_als_build=${PCL_ALS_BUILD_DIR:-$pcl_als_root/build-headers}
pcl_als_configure -DBUILD_TESTING=ON -DPCL_ALS_UNITY_BUILD=OFF -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON
cd -- "$pcl_als_build"
awk -f "$commands" compile_commands.json | cut -f 2 | grep -E " -c .*(${1:-.})" |
  sed -E 's/ -o [^ ]+ -c / -fsyntax-only /' |
  xargs -d '\n' -P "$(nproc)" -I '{}' sh -c '{}'
echo "Every source includes what it uses."
