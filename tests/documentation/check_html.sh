#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# check_html.sh SOURCE_DIR SCRATCH_DIR DOXYGEN: the manual as HTML is made without a warning, without
# anything from the network, and what its pages name is there.
set -euo pipefail
export LC_ALL=C
output=$2/html_manual
"$1/share/doc/doxygen/build.sh" "$1" "$output" test "$3"
[[ ! -s $output/warnings.txt ]] || { echo "FAILED: warnings of Doxygen"; exit 1; }
cd -- "$output/html"
failures=0
failed() { echo "FAILED: $1"; failures=$((failures + 1)); }
grep -lE '<(script|img|link)[^>]*(src|href)="https?:' ./*.html >remote.txt && failed "loads from the network: $(head -n 3 remote.txt)"
places=0
for page in index.html share_*.html modules_*.html tests_*.html README.html; do
  while IFS= read -r target; do
    places=$((places + 1))
    file=${target%%#*} anchor=
    [[ $target != *"#"* ]] || anchor=${target#*#}
    [[ -n $file ]] || file=$page
    [[ -e $file ]] || { failed "$page: $target: there is no $file"; continue; }
    [[ -z $anchor ]] || grep -qE "(id|name)=\"$anchor\"" "$file" || failed "$page: $target: no such anchor"
  done < <(grep -oE '(href|src)="[^"]*"' "$page" | sed -E 's/^[a-z]+="//; s/"$//' | grep -vE '^([a-z]+:|#$)' | sort -u)
done
((places > 500)) || failed "only $places links"
echo "$places links of HTML pages, $failures failed"
((failures == 0)) || exit 1
rm -rf -- "$output"
