#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# share/dev/check.sh [LAYER…]: the checks that tests/run.sh leaves out because they compile much or
# take long. Without arguments all layers run, one after the other. Every layer prints one line with
# its result and time, and its output is in build-check/LAYER.log. Ends with status 1 if one failed.
#   format         clang-format on every C++ file
#   architecture   dependencies of modules, lengths, words, pages
#   install        packages, installed headers, consumers, the Python wheel, a build without options
#   slow           tests that start tools a thousand times
#   tidy           clang-tidy on all modules and tools
#   headers        every source compiles on its own, without precompiled headers
#   no-unity       the tools are built and linked without unity build and precompiled headers
#   clang          the tools are built with clang++ and the fast tests pass
#   sanitize       the tests with AddressSanitizer and UndefinedBehaviorSanitizer
#   threads        readers and the thread pool with ThreadSanitizer
#   fuzz           every fuzzer, 5 minutes in all
#   bookworm       both commands of the README in a new Debian 12
#   trixie         both commands of the README in a new Debian 13
# PCL_ALS_CHECK_DIR is the folder of build folders and logs (default: build-check in the sources).
source "$(dirname -- "${BASH_SOURCE[0]}")/../packages.sh"
layers=(format architecture install slow tidy headers no-unity clang sanitize threads fuzz bookworm trixie)
here=$pcl_als_root/share/dev
folder=${PCL_ALS_CHECK_DIR:-$pcl_als_root/build-check}

usage() { sed -n '5,22s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; }

# build NAME TARGET [-Doption…]: configures a build folder of the layer and builds a target in it.
build() {
  pcl_als_build=$folder/$1
  pcl_als_configure "${@:3}"
  cmake --build "$pcl_als_build" --target "$2"
}

# tests [ctest options]: the tests of the build folder of the layer.
tests() { (cd -- "$pcl_als_build" && ctest --output-on-failure --timeout 3600 -j "$(nproc)" "$@"); }

layer_format() { "$here/format.sh" --check; }
layer_architecture() { "$pcl_als_root/tests/architecture/check.sh" "$pcl_als_root"; }
layer_install() { "$pcl_als_root/tests/run.sh" -L install; }
layer_slow() { "$pcl_als_root/tests/run.sh" -L slow; }
layer_tidy() { PCL_ALS_BUILD_DIR=$folder/tidy "$here/tidy.sh"; }
layer_headers() { PCL_ALS_BUILD_DIR=$folder/headers "$here/headers.sh"; }
layer_no-unity() {
  build no-unity all -DBUILD_TESTING=OFF -DPCL_ALS_UNITY_BUILD=OFF -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON
}
layer_clang() {
  build clang all -DBUILD_TESTING=ON -DCMAKE_CXX_COMPILER=clang++
  tests -L fast
}
layer_sanitize() { PCL_ALS_BUILD_DIR=$folder/sanitize "$here/sanitize.sh" address,undefined -LE "install|slow"; }
layer_threads() {
  local names=(test_point_reader test_parallel test_point_conversion test_block_stages)
  build threads all -DBUILD_TESTING=ON -DCMAKE_BUILD_TYPE=RelWithDebInfo -DPCL_ALS_SANITIZE=thread
  tests -R "^($(IFS='|'; echo "${names[*]}"))$"
}
layer_fuzz() {
  build fuzz fuzzers -DBUILD_TESTING=ON -DCMAKE_CXX_COMPILER=clang++ -DPCL_ALS_BUILD_FUZZERS=ON \
    -DPCL_ALS_SANITIZE=address,undefined
  local fuzzers=("$pcl_als_build"/bin/fuzz_*)
  "$pcl_als_root/tests/fuzz/fuzz_all.sh" "$pcl_als_build/bin" "$folder/fuzz_work" $((300 / ${#fuzzers[@]} + 1))
  [[ -z $(ls -A -- "$folder/fuzz_work/findings") ]]
}
layer_bookworm() { "$here/fresh_root.sh" -d "$folder/bookworm" bookworm; }
layer_trixie() { "$here/fresh_root.sh" -d "$folder/trixie" trixie; }

case ${1:-} in
  -h) usage; exit 0 ;;
  -run) "layer_$2"; exit 0 ;;  # in a process of its own, which ends with the first command that fails
esac
(($#)) || set -- "${layers[@]}"
for layer in "$@"; do
  [[ " ${layers[*]} " == *" $layer "* ]] || { echo "check.sh: there is no layer $layer (see -h)" >&2; exit 1; }
done
mkdir -p -- "$folder"
status=0
for layer in "$@"; do
  started=$SECONDS result=passed
  "${BASH_SOURCE[0]}" -run "$layer" >"$folder/$layer.log" 2>&1 </dev/null ||
    result="FAILED, see $folder/$layer.log" status=1
  printf '%-13s %6d s  %s\n' "$layer" "$((SECONDS - started))" "$result"
done
exit "$status"
