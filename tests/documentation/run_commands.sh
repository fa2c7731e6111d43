#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# run_commands.sh SOURCE_DIR BIN_DIR SCRATCH_DIR: runs the commands of the manual as a reader does
# who follows it: the pages in the order of its first page, in one folder that is empty at the
# start, with the tools of BIN_DIR. Compares the output that the pages show with what is printed.
#
# Blocks of the pages: ```sh is run, ```text after it is its output or a part of it, and ```shell is
# what a fresh machine needs before: it is run, in SOURCE_DIR, where PCL_ALS_MANUAL_FRESH is set.
set -uo pipefail
shopt -s nullglob
export LC_ALL=C
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
sources=$(cd -- "$1" && pwd -P)
bin=$2 scratch=$3/manual
rm -rf -- "$scratch" && mkdir -p -- "$scratch/work" "$scratch/output" || exit 1
cd -- "$sources/share/doc" || exit 1

mapfile -t pages < <(
  awk -f "$here/../../share/doc/doxygen/anchor.awk" -f "$here/markdown.awk" README.md |
  awk -F '\t' '$1 == "link" && $4 ~ /^[a-z_]+\.md$/ && !seen[$4]++ { print $4 }')
pages=(README.md "${pages[@]}")
if [[ -n ${PCL_ALS_MANUAL_FRESH:-} ]]; then
  awk -v output="$scratch/output" -v kinds=" shell " -f "$here/commands.awk" "${pages[@]}" >"$scratch/install.sh"
  (cd -- "$sources" && bash "$scratch/install.sh") || exit 1
  rm -f -- "$scratch"/output/*
fi
awk -v output="$scratch/output" -v kinds=" sh " -f "$here/commands.awk" "${pages[@]}" >"$scratch/commands.sh"
cd -- "$scratch/work" || exit 1
failures=0
if ! env -u DISPLAY PATH="$bin:$PATH" bash "$scratch/commands.sh" 2>"$scratch/failed.txt"; then
  failures=1
  cat "$scratch/failed.txt"
  tail -n 20 "$(ls -t "$scratch"/output/*.out | head -n 1)"
fi
blocks=0 shown=0
for output in "$scratch"/output/*.out; do
  blocks=$((blocks + 1))
  expected=${output%.out}.expected
  [[ -e $expected ]] || continue
  shown=$((shown + 1))
  awk -f "$here/compare_output.awk" "$expected" "$output" || failures=$((failures + 1))
done
((blocks > 0)) || { echo "the manual has no commands"; failures=1; }
echo "$blocks blocks of commands, the output of $shown compared, $failures failed"
((failures == 0)) || exit 1
rm -rf -- "$scratch/work"
