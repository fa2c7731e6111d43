#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# check_figures.sh SOURCE_DIR SCRATCH_DIR: the figures of accuracy.md are those of the benchmark pages
# (share/dev/quoted_figures.py), and figures that are not are found in copies of the pages.
set -euo pipefail
export LC_ALL=C.UTF-8
root=$1 scratch=$2/figures
figures=$root/share/dev/quoted_figures.py
python3 "$figures" "$root"

failures=0
expect() {  # status, text, options
  local output status=0
  output=$(python3 "$figures" "$scratch" "${@:3}" 2>&1) || status=$?
  if [[ $status != "$1" || $output != *"$2"* ]]; then
    echo "expected status $1 and '$2', got $status and: $output"
    failures=$((failures + 1))
  fi
}
make_pages() {
  rm -rf -- "$scratch" && mkdir -p -- "$scratch/share/doc" "$scratch/tests/benchmarks"
  cp -- "$root/share/doc/accuracy.md" "$scratch/share/doc"
  cp -- "$root"/tests/benchmarks/*.md "$scratch/tests/benchmarks"
}
page=$scratch/share/doc/accuracy.md diagnosis=$scratch/tests/benchmarks/diagnosis.md
quoted=$(grep -o 'above 0.9 in [0-9]* of [0-9]* blocks' "$root/share/doc/accuracy.md")

make_pages && sed -i 's/above 0.9 in [0-9]* of/above 0.9 in 999 of/' "$page"
expect 1 "999 is "
expect 1 "999 is " --write
grep -q "$quoted" "$page" || { echo "--write does not restore '$quoted'"; failures=$((failures + 1)); }
expect 0 "are those of the benchmark pages"
make_pages && sed -i 's/in [0-9]* of the \([0-9]* blocks that have any\)/in 7 of the \1/' "$diagnosis"
expect 1 " is 7 in the benchmark page"
make_pages && sed -i 's/occurs in one of the/occurs in two of the/' "$diagnosis"
expect 1 "diagnosis.md: has no sentence"
make_pages && echo "It takes 17 s." >>"$page"
expect 1 "17 is no quotation"
make_pages && sed -i 's/Known reflectances are met/All reflectances are met/; s/met within/right to/' "$page"
expect 1 "has 0 texts 'met within # %'"
((failures == 0)) || exit 1
echo "All wrong figures were found."
