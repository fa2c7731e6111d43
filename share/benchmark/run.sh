#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# share/benchmark/run.sh [OUTPUT] [options of run.py]: the whole benchmark on a fresh Debian. Installs
# what is missing, with Open3D where the distribution has it, builds the tools, and runs run.py.
#   PCL_ALS_BUILD_DIR  build folder (default: build/ in the sources)
if [[ ${1:-} == -h || ${1:-} == --help ]]; then
  sed -n '5,7s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"
  exit 0
fi
source "$(dirname -- "${BASH_SOURCE[0]}")/../packages.sh"

pcl_als_step "Installing what is missing"
pcl_als_install build benchmark
if [[ -n $(apt-cache search --names-only '^python3-open3d$' 2>/dev/null) ]]; then
  pcl_als_install open3d
fi
pcl_als_step "Building in $pcl_als_build"
pcl_als_configure
cmake --build "$pcl_als_build" --target pcl_als_app_{simulate,calibrate,apply,trajectory}
pcl_als_step "Running the benchmark"
/usr/bin/python3 "$pcl_als_root/share/benchmark/run.py" --tools "$pcl_als_build/bin" "$@"
