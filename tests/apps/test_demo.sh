#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# The demo as a user runs it, over its small block, with the tools of this build: what it says is there is there, the
# second run repeats nothing, and a browser shows its pages with the numbers of the JSON.
source "$(dirname -- "$0")/tool_test.sh"
source "$here/report_page.sh"
unset DISPLAY
export PCL_ALS_BUILD_DIR=${bin%/bin} PCL_ALS_DEMO_PRESET=small
demo() { timeout 600 "$here/../../share/demo/run.sh" "$scratch/demo" >"$1" 2>&1; }
check "the demo runs" demo first.txt || cat first.txt
for path in $(awk '$1 ~ "^/" { print $1 }' first.txt); do
  check "$path is there" test -e "$path"
done
check "its tables compare with the truth" grep -q 'boresight_roll .* arcsec' first.txt
check "the demo runs again" demo second.txt
check "and repeats nothing" eval '! grep -qE "^(Simulating|Adjusting|Measuring|Drawing)" second.txt'

browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome)
if [[ -z $browser ]]; then
  echo "SKIPPED: the pages in a browser: chromium is not installed"
  finish
fi
cd -- "$scratch/demo" || exit 1
shown report verdict_agrees
shown quality quality_agrees
rm -rf -- "$scratch/browser" "$scratch/demo"
finish
