#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# share/dev/headers.sh [REGEX]: reads the sources whose path matches (default: all) without precompiled
# headers and names those that do not include what they use. The build folder must be configured.
source "$(dirname -- "${BASH_SOURCE[0]}")/../packages.sh"
commands=$pcl_als_root/share/dev/compile_commands.awk
cd -- "$pcl_als_build"
awk -f "$commands" compile_commands.json | cut -f 2 | grep -E " -c .*(${1:-.})" |
  sed -E 's/ -Winvalid-pch -include [^ ]*cmake_pch\.hxx//; s/ -o [^ ]+ -c / -fsyntax-only /' |
  xargs -d '\n' -P "$(nproc)" -I '{}' sh -c '{}'
echo "Every source includes what it uses."
