# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# Sourced by share/demo/run.sh, share/benchmark/run.sh and tests/run.sh: what a fresh Debian (12 or 13) needs, and how the
# project is configured there. Strict mode and the C locale are set for the caller.
set -euo pipefail
export LC_ALL=C

pcl_als_root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd -P)
pcl_als_build=${PCL_ALS_BUILD_DIR:-$pcl_als_root/build}

# One entry per Debian package; after the colon the program or file that makes it unnecessary. What
# every Debian has (packages marked essential, e.g. coreutils, grep, perl-base) is not listed;
# tests/architecture/programs.sh finds programs of scripts that are missing here.
pcl_als_packages_build=(
  g++:c++ cmake:cmake ninja-build:ninja ccache:ccache mawk:awk
  libpcl-dev libeigen3-dev libproj-dev libgdal-dev
  python3-dev pybind11-dev:/usr/include/pybind11/pybind11.h
  libceres-dev nlohmann-json3-dev:/usr/include/nlohmann/json.hpp
  libcairo2-dev:/usr/include/cairo/cairo.h libfmt-dev:/usr/include/fmt/format.h
  fonts-dejavu-core:/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf fontconfig:fc-cache
)
pcl_als_packages_test=(
  libgtest-dev:/usr/include/gtest/gtest.h
  xz-utils:xz           # real data
  mount:mount           # full and read-only disks
  procps:pgrep          # processes that are left behind
  chromium:chromium     # reports in a browser
  xvfb:Xvfb             # windows
  file:file dpkg-dev:dpkg-shlibdeps lintian:lintian  # CPack's Debian packages, and what is wrong with them
  python3-jsonschema                                 # result files against their schemas
  python3-numpy python3-matplotlib python3-venv      # the Python package, its examples, its installation
)

pcl_als_packages_benchmark=(python3-numpy)
pcl_als_packages_open3d=(python3-open3d)

_pcl_als_present() {  # package[:program-or-file]
  local package=${1%%:*} witness=${1#*:}
  [[ $witness == "$package" ]] || {
    if [[ $witness == /* ]]; then [[ -e $witness ]] && return 0
    else command -v "$witness" >/dev/null && return 0; fi
  }
  [[ $(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null) == installed ]]
}

# pcl_als_install GROUP…: installs what is missing with apt-get. Asks for nothing, touches no
# network when all is there.
pcl_als_install() {
  local group entry missing=()
  for group in "$@"; do
    local -n list=pcl_als_packages_$group
    for entry in "${list[@]}"; do
      _pcl_als_present "$entry" || missing+=("${entry%%:*}")
    done
  done
  ((${#missing[@]})) || { echo "All packages are installed."; return 0; }
  echo "Missing packages: ${missing[*]}"
  command -v apt-get >/dev/null || {
    echo "This is no Debian system (no apt-get): install what these packages hold, then run again." >&2
    return 1
  }
  local as_root=()
  if [[ $(id -u) != 0 ]]; then
    command -v sudo >/dev/null || {
      echo "Run as root: apt-get install --no-install-recommends ${missing[*]}" >&2
      return 1
    }
    as_root=(sudo)
  fi
  local apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o DPkg::Lock::Timeout=600
             -o Acquire::Retries=3 -o Dpkg::Use-Pty=0)
  local log
  log=$(mktemp)
  if "${apt[@]}" update >"$log" 2>&1 &&
     "${apt[@]}" install -y --no-install-recommends "${missing[@]}" >>"$log" 2>&1 </dev/null; then
    rm -f -- "$log"
    pcl_als_installed=yes
  else
    tail -n 20 "$log" >&2
    echo "apt-get could not install ${missing[*]} (whole log: $log)" >&2
    return 1
  fi
}

# pcl_als_configure [-Doption=…]: Release with ninja in the build folder; one that exists keeps its
# generator and options. A build folder that was moved with its sources is configured anew.
pcl_als_configure() {
  local cache=$pcl_als_build/CMakeCache.txt first=()
  if [[ -f $cache ]] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$pcl_als_root" "$cache"; then
    rm -rf -- "$cache" "$pcl_als_build/CMakeFiles"
  fi
  [[ -f $cache ]] || first=(-G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=OFF)
  # Where nothing is new, building configures again if files of CMake changed.
  [[ $# -gt 0 || ${#first[@]} -gt 0 || -n ${pcl_als_installed:-} ||
     ! -f $pcl_als_build/cmake_install.cmake ]] || return 0
  local log=$pcl_als_build/configure.log
  mkdir -p -- "$pcl_als_build"
  cmake -S "$pcl_als_root" -B "$pcl_als_build" "${first[@]}" "$@" >"$log" 2>&1 || {
    cat "$log" >&2
    return 1
  }
}

# pcl_als_step "what": prints a heading with the time since the start.
pcl_als_started=$SECONDS
pcl_als_step() { printf '\n== [%4d s] %s\n' "$((SECONDS - pcl_als_started))" "$1"; }
