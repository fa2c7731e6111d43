#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# build.sh SOURCE_DIR OUTPUT_DIR VERSION DOXYGEN [DOT]: makes the manual with the reference of all
# public headers as OUTPUT_DIR/html. Prints the warnings of Doxygen, which are in warnings.txt, too.
set -euo pipefail
export LC_ALL=C
sources=$1 output=$2 version=$3 doxygen=$4 dot=${5:-}
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
rm -rf -- "$output" && mkdir -p -- "$output/html"
cd -- "$sources"

# Pages: all Markdown of the project but what developers alone need.
find README.md CHANGELOG.md CONTRIBUTING.md HOWTORELEASE.md SECURITY.md modules share/GLOSSARY.md \
  share/benchmark share/design share/dev share/doc share/examples share/packaging tests -name '*.md' | sort >"$output/pages.txt"
while IFS= read -r page; do
  mkdir -p -- "$output/pages/$(dirname -- "$page")"
  awk -v page="$page" -v pages="$output/pages.txt" -f "$here/anchor.awk" -f "$here/page.awk" \
    "$page" >"$output/pages/$page"
done <"$output/pages.txt"
# Other files of the project that pages link.
grep -rhoE '(href|src)="files/[^"]+"' "$output/pages" | sed -E 's/^[a-z]+="files\///; s/"$//' |
  sort -u | while IFS= read -r file; do
    mkdir -p -- "$output/html/files/$(dirname -- "$file")"
    cp -r -- "$file" "$output/html/files/$file"
  done

includes=(modules/*/include modules/*/internal)
{
  cat "$here/Doxyfile"
  printf 'PROJECT_NUMBER = %s\nOUTPUT_DIRECTORY = "%s"\n' "$version" "$output"
  printf 'USE_MDFILE_AS_MAINPAGE = "%s"\n' "$output/pages/share/doc/README.md"
  # The order of the pages in the navigation.
  printf 'INPUT ='
  for page in share/doc share/GLOSSARY.md README.md share/examples modules tests share/benchmark \
    share/design share/dev share/packaging CONTRIBUTING.md HOWTORELEASE.md SECURITY.md CHANGELOG.md; do
    printf ' "%s"' "$output/pages/$page"
  done
  printf ' "%s"' "${includes[@]/#/$sources/}"
  printf '\nSTRIP_FROM_PATH = "%s"' "$output/pages"
  printf ' "%s"' "${includes[@]/#/$sources/}"
  printf '\nSTRIP_FROM_INC_PATH ='
  printf ' "%s"' "${includes[@]/#/$sources/}"
  printf '\nWARN_LOGFILE = "%s"\n' "$output/warnings.txt"
  # Doxygen looks for dot unless this says otherwise.
  if [[ -n $dot ]]; then printf 'HAVE_DOT = YES\nDOT_PATH = "%s"\n' "$dot"; else echo 'HAVE_DOT = NO'; fi
} >"$output/Doxyfile"
"$doxygen" "$output/Doxyfile"
if [[ -s $output/warnings.txt ]]; then
  cat -- "$output/warnings.txt" >&2
  echo "$(grep -c 'warning:' "$output/warnings.txt") warnings of Doxygen" >&2
fi
rm -rf -- "$output/pages" "$output/pages.txt"
echo "The manual: $output/html/index.html"
