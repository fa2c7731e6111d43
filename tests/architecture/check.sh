#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# check.sh SOURCE_DIR: checks the dependencies of modules, the length of files and functions, and the
# form of the documentation. Prints every breach with its file, and ends with status 1 if there is one.
set -euo pipefail
export LC_ALL=C
shopt -s extglob
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
cd -- "$1"
breaches=0
breach() { echo "$1: $2"; breaches=$((breaches + 1)); }

# What a module may declare: modules of the same or a lower level; only processing and report may
# use drawing, and none visualization (VTK). The Python package is above all of them. An estimator that used simulation would share its errors: only the writer of
# simulated surveys does.
declare -A may=(
  [common]="" [adjustment]="common" [crs]="common" [las]="common crs" [io]="common crs las" [trajectory]="common adjustment"
  [survey]="common io trajectory" [tin]="common" [registration]="common adjustment tin"
  [calibration]="common adjustment io trajectory survey tin registration" [radiometry]="common adjustment trajectory tin"
  [photogrammetry]="common adjustment tin" [waveform]="common adjustment las io"
  [filters]="common las trajectory tin radiometry"
  [classification]="common tin" [quality]="common adjustment tin registration trajectory"
  [history]="common io"
  [processing]="common io trajectory survey registration calibration radiometry filters quality classification photogrammetry drawing simulation waveform"
  [report]="common io survey registration calibration radiometry quality history photogrammetry classification processing drawing"
  [simulation]="common" [mpi]="common" [drawing]="common io" [visualization]="common drawing"
  [python]="common io survey trajectory registration calibration radiometry filters quality classification photogrammetry simulation processing report"
)

# The modules that X declares in its CMakeLists.txt: the words after MODULES. Further libraries of a
# module (io_raster, survey_coverage, report_page) are part of it.
declared() {
  awk '{ sub(/#.*/, ""); gsub(/[()]/, " & ");
         for (i = 1; i <= NF; ++i) {
           if ($i ~ /^[A-Z]+$/ || $i == ")") on = ($i == "MODULES");
           else if (on) print $i } }' "modules/${1%_@(raster|picture|page|coverage|simulation|bundle|dense)}/CMakeLists.txt"
}
declare -A reach
closure() {  # X and all that it declares, directly or through others
  [[ -n ${reach[$1]:-} ]] && return
  local all=" $1 ${1%_@(raster|picture|page|coverage|simulation|bundle|dense)} " next
  reach[$1]=$all  # a cycle of declarations ends here and is reported as a breach
  for next in $(declared "$1"); do
    closure "$next"
    all+="${reach[$next]} "
  done
  reach[$1]=$all
}

includes() {  # FILE: line number and target of each include
  sed -nE 's/^[[:space:]]*#[[:space:]]*include[[:space:]]*([<"][^>"]*[>"]).*/\1/p' "$1"
}

for folder in modules/*/; do
  module=$(basename -- "$folder")
  [[ -v "may[$module]" ]] || { breach "modules/$module" "unknown module: add it to $0"; continue; }
  for other in $(declared "$module"); do
    [[ " $module ${may[$module]} " == *" ${other%_@(raster|picture|page|coverage|simulation|bundle|dense)} "* ]] ||
      breach "modules/$module/CMakeLists.txt" "must not use module $other"
  done
  grep -qE 'pcl_als::|pcl_als_app|pcl_visualization|VTK::' "modules/$module/CMakeLists.txt" &&
    [[ $module != visualization ]] &&
    breach "modules/$module/CMakeLists.txt" "links a module, a tool or VTK without MODULES"
  closure "$module"
  while IFS= read -r file; do
    while IFS= read -r target; do
      case $target in
        "<pcl_als/"*)
          used=${target#<pcl_als/}
          [[ ${reach[$module]} == *" ${used%%/*} "* ]] ||
            breach "$file" "includes $target, but $module does not declare module ${used%%/*}"
          [[ $used != simulation/* || $module == simulation || $file == */simulated_@(survey|images).* ]] ||
            breach "$file" "includes $target: only the writers of simulated surveys use module simulation"
          [[ $module != calibration || $used != las/* ]] ||
            breach "$file" "includes $target: module $module reads points through module survey" ;;
        *'../'*) breach "$file" "includes $target across folders" ;;
        \"*)
          [[ -e $(dirname -- "$file")/${target//\"/} ]] ||
            breach "$file" "includes $target, which is not beside it" ;;
        "<vtk"* | "<pcl/visualization/"*)
          [[ $module == visualization ]] || breach "$file" "includes $target: only visualization uses VTK" ;;
        "<boost/mpi"* | "<mpi.h>")
          [[ $module == mpi ]] || breach "$file" "includes $target: only module mpi uses MPI" ;;
        "<gtest/"*) breach "$file" "includes $target in a library" ;;
      esac
    done < <(includes "$file")
    # Only the display of progress is meant to print.
    if [[ $file != *.md && $file != */console_progress.cpp ]] && grep -nE '(std::(cout|cerr|clog)|[^sn:_a-zA-Z](f|std::)?printf *\(|PCL_(ERROR|WARN|INFO)) *' "$file" |
         grep -vE '^[0-9]+: *(//|\*|/\*)' >/dev/null; then
      breach "$file" "prints: a library reports through results and exceptions"
    fi
  done < <(find "$folder" -name '*.h' -o -name '*.hpp' -o -name '*.cpp' | sort)
  [[ -e modules/$module/README.md ]] || breach "modules/$module" "has no README.md"
done

# Messages of a library do not name options of the tools: a tool adds the name of its own (Remedy).
while IFS= read -r place; do
  breach "$place" "names an option of a tool in a library"
done < <(find modules \( -name '*.h' -o -name '*.hpp' -o -name '*.cpp' \) \
  -exec awk '
    /^[[:space:]]*(\/\/|\*|\/\*)/ { next }
    { gsub(/\047\\?"\047/, "")  # the character, which begins no text
      for (rest = $0; match(rest, /"([^"\\]|\\.)*"/); rest = substr(rest, RSTART + RLENGTH)) {
        if (substr(rest, 1, RSTART - 1) ~ /\/\//) break
        text = substr(rest, RSTART, RLENGTH)
        if (text ~ /["(,;: \047`]--?[a-z][a-z_]+/) print FILENAME ":" FNR ": " text } }' {} +)

# A user of the calibration needs settings, result and one class; internal headers are in src/.
installed=(modules/calibration/include/pcl_als/calibration/*.h)
((${#installed[@]} <= 4)) ||
  breach modules/calibration "installs ${#installed[@]} headers, more than 4"

# Every source file has a licence and at most 400 lines.
while IFS= read -r file; do
  head -n 6 -- "$file" | grep -q 'SPDX-License-Identifier: BSD-3-Clause' ||
    breach "$file" "has no SPDX line"
  lines=$(wc -l <"$file")
  ((lines <= 400)) || breach "$file" "has $lines lines, more than 400"
done < <(find modules apps tests share \( -name '*.h' -o -name '*.hpp' -o -name '*.cpp' -o -name '*.sh' \) | sort)

# Functions are short enough to be read at once.
while IFS=$'\t' read -r lines file line signature; do
  ((lines <= 57)) || breach "$file:$line" "a function of $lines lines, more than 57: $signature"
done < <(find modules apps \( -name '*.h' -o -name '*.hpp' -o -name '*.cpp' \) -exec \
  awk -f "$here/function_lengths.awk" {} +)

# Every table of the glossary has the same columns.
if [[ -e share/GLOSSARY.md ]] && grep -B1 -E '^\|[-|]+\|$' share/GLOSSARY.md | grep -vE '^(--|\|-)' |
     grep -qvFx '| term | symbol | unit | definition | where used |'; then
  breach share/GLOSSARY.md "has a table without term, symbol, unit, definition and where used"
fi

# Every module page has the same sections, and lines of text in Markdown have less than 100
# characters (tables may be wider).
for page in modules/*/README.md; do
  for section in Purpose Usage Method Limits Constants; do
    grep -qx "## $section" "$page" || breach "$page" "has no section $section"
  done
done
while IFS= read -r place; do
  breach "$place" "has 100 characters or more"
done < <(find . -name '*.md' -not -path './.git/*' -not -path './build*' \
  -not -path './pcl_als_demo/*' -exec \
  awk '{ gsub(/[\200-\277]/, "") } length($0) > 99 && !/^\|/ { print FILENAME ":" FNR }' {} +)

# A file that no CMakeLists.txt lists is not built.
while IFS= read -r file; do
  list=$(dirname -- "$file")
  until [[ -e $list/CMakeLists.txt ]]; do list=$(dirname -- "$list"); done
  stem=$(basename -- "$file" .cpp)
  grep -qF -- "${stem#test_}" "$list/CMakeLists.txt" ||
    breach "$file" "is not listed in $list/CMakeLists.txt"
done < <(find modules apps tests share/examples -name '*.cpp' | sort)

((breaches == 0)) || { echo "$breaches breaches of the architecture"; exit 1; }
echo "The modules keep to the architecture."
