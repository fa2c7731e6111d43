#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# check_links.sh SOURCE_DIR: every relative link in the Markdown pages below SOURCE_DIR names a file
# or folder that is there, and an anchor a heading of that page; every page of the manual is reached
# from its first page. Prints every fault with its place, and ends with status 1 if there is one.
set -euo pipefail
export LC_ALL=C
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
cd -- "$1"
root=$(pwd -P)
faults=0
fault() { echo "$1: $2"; faults=$((faults + 1)); }

mapfile -t pages < <(find . -name '*.md' -not -path './.git/*' -not -path './build*' | sed 's|^\./||' | sort)
((${#pages[@]})) || { echo "no Markdown page in $root"; exit 1; }
facts=$(awk -f "$here/../../share/doc/doxygen/anchor.awk" -f "$here/markdown.awk" "${pages[@]}")

declare -A anchors linked
while IFS=$'\t' read -r _ page _ anchor; do anchors[$page#$anchor]=1; done < <(grep '^anchor' <<<"$facts")

links=0
while IFS=$'\t' read -r _ page line target; do
  links=$((links + 1))
  path=${target%%#*} anchor=
  [[ $target != *"#"* ]] || anchor=${target#*#}
  if [[ $path == /* ]]; then
    fault "$page:$line" "$target: a link of the project is relative"
    continue
  fi
  file=$page
  if [[ -n $path ]]; then
    file=$(realpath -m --relative-to="$root" -- "$(dirname -- "$page")/$path")
    [[ $file != ../* ]] || { fault "$page:$line" "$target: outside of the project"; continue; }
    [[ -e $file ]] || { fault "$page:$line" "$target: there is no $file"; continue; }
  fi
  linked[$page]+=" $file"
  [[ -z $anchor || -v "anchors[$file#$anchor]" ]] ||
    fault "$page:$line" "$target: $file has no heading with the anchor $anchor"
done < <(grep '^link' <<<"$facts")

# The pages of the manual that its first page leads to.
first=share/doc/README.md
if [[ -e $first ]]; then
  declare -A reached=([$first]=1)
  queue=("$first")
  while ((${#queue[@]})); do
    page=${queue[0]}
    queue=("${queue[@]:1}")
    for next in ${linked[$page]:-}; do
      [[ $next == share/doc/*.md && ! -v "reached[$next]" ]] || continue
      reached[$next]=1
      queue+=("$next")
    done
  done
  for page in share/doc/*.md; do
    [[ -v "reached[$page]" ]] || fault "$page" "is not linked by a page that $first leads to"
  done
fi

((faults == 0)) || { echo "$faults broken links"; exit 1; }
echo "$links links in ${#pages[@]} pages lead to files and headings."
