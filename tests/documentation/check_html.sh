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
# Markdown that Doxygen did not understand remains as it is, or as a command.
grep -nE '&lt;tt&gt;|^@(section|code|ref|anchor)' share_*.html modules_*.html tests_*.html README.html >raw.txt &&
  failed "not understood: $(head -n 3 raw.txt)"
# Every place that a page names, and whether it is there: first all anchors, then the links.
grep -oE '(id|name)="[^"]*"' ./*.html | sed -E 's/^\.\/([^:]*):[a-z]+="(.*)"$/\1#\2/' | sort -u >anchors.txt
grep -oE '(href|src)="[^"]*"' index.html share_*.html modules_*.html tests_*.html README.html |
  sed -E 's/^([^:]*):[a-z]+="(.*)"$/\1\t\2/' | grep -vE $'\t([a-z]+:|#$)' | sort -u >links.txt
places=$(wc -l <links.txt)
while IFS= read -r fault; do
  failed "$fault"
done < <(awk -F '\t' 'FNR == NR { there[$0] = 1; next }
  { target = $2
    if (target ~ /^#/) target = $1 target
    if (target ~ /#/ && !(target in there)) print $1 ": there is no " target }' anchors.txt links.txt
  cut -f 2 links.txt | sed 's/#.*//; /^$/d' | sort -u |
    while IFS= read -r file; do [[ -e $file ]] || echo "there is no $file"; done)
((places > 500)) || failed "only $places links"
echo "$places links of HTML pages, $failures failed"
((failures == 0)) || exit 1
rm -rf -- "$output"
