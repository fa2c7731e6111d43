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
  [filters]="common las trajectory tin radiometry waveform"
  [classification]="common tin" [quality]="common adjustment tin registration trajectory"
  [history]="common io"
  [processing]="common io trajectory survey registration calibration radiometry filters quality classification photogrammetry drawing simulation waveform"
  [report]="common io survey registration calibration radiometry quality history photogrammetry classification processing drawing"
  [simulation]="common" [mpi]="common" [drawing]="common io" [visualization]="common drawing"
  [python]="common io survey trajectory registration calibration radiometry filters quality classification photogrammetry simulation processing report"
)

# The module of a library: further libraries of a module (io_raster, survey_coverage, report_page) are part of it.
module_of() { module=${1%_@(raster|picture|page|coverage|simulation|bundle|dense)}; }

# What a module declares in its CMakeLists.txt: the words after MODULES.
declare -A declared
while IFS=$'\t' read -r module other; do declared[$module]+=" $other"; done < <(awk '
  FNR == 1 { on = 0; split(FILENAME, folder, "/") }
  { sub(/#.*/, ""); gsub(/[()]/, " & ")
    for (i = 1; i <= NF; ++i) {
      if ($i ~ /^[A-Z]+$/ || $i == ")") on = ($i == "MODULES")
      else if (on) print folder[2] "\t" $i } }' modules/*/CMakeLists.txt)
declare -A reach
closure() {  # X and all that it declares, directly or through others
  [[ -n ${reach[$1]:-} ]] && return
  local module next
  module_of "$1"
  local all=" $1 $module "
  reach[$1]=$all  # a cycle of declarations ends here and is reported as a breach
  for next in ${declared[$module]:-}; do
    closure "$next"
    all+="${reach[$next]} "
  done
  reach[$1]=$all
}

# sources FOLDER…: the C++ files in these folders.
sources() { find "$@" \( -name '*.h' -o -name '*.hpp' -o -name '*.cpp' \); }

# One process reads many files: starting one for each file would take minutes.
# each AWK_PROGRAM: applies the program to the files that are named on standard input.
each() { sort | tr '\n' '\0' | xargs -0 -r awk "$1"; }

for folder in modules/*/; do
  name=${folder#modules/} name=${name%/}
  [[ -v "may[$name]" ]] || { breach "modules/$name" "unknown module: add it to $0"; continue; }
  for other in ${declared[$name]:-}; do
    module_of "$other"
    [[ " $name ${may[$name]} " == *" $module "* ]] ||
      breach "modules/$name/CMakeLists.txt" "must not use module $other"
  done
  closure "$name"
  [[ -e modules/$name/README.md ]] || breach "modules/$name" "has no README.md"
done
while IFS= read -r file; do
  [[ $file == modules/visualization/* ]] || breach "$file" "links a module, a tool or VTK without MODULES"
done < <(grep -lE 'pcl_als::|pcl_als_app|pcl_visualization|VTK::' modules/*/CMakeLists.txt)

while IFS=$'\t' read -r file target; do
  module=${file#modules/} module=${module%%/*}
  [[ -v "reach[$module]" ]] || continue
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
      [[ -e ${file%/*}/${target//\"/} ]] ||
        breach "$file" "includes $target, which is not beside it" ;;
    "<vtk"* | "<pcl/visualization/"*)
      [[ $module == visualization ]] || breach "$file" "includes $target: only visualization uses VTK" ;;
    "<boost/mpi"* | "<mpi.h>")
      [[ $module == mpi ]] || breach "$file" "includes $target: only module mpi uses MPI" ;;
    "<gtest/"*) breach "$file" "includes $target in a library" ;;
  esac
done < <(sources modules | each '
  match($0, /^[ \t]*#[ \t]*include[ \t]*(<[^>]*>|"[^"]*")/) {
    target = substr($0, RSTART, RLENGTH)
    sub(/^[^<"]*/, "", target)
    print FILENAME "\t" target }')

# Only the display of progress is meant to print.
while IFS= read -r place; do
  breach "$place" "prints: a library reports through results and exceptions"
done < <(sources modules | grep -v '/console_progress.cpp$' | each '
  /^[ \t]*(\/\/|\*|\/\*)/ { next }
  /std::(cout|cerr|clog)|[^sn:_a-zA-Z](f|std::)?printf *\(|PCL_(ERROR|WARN|INFO)/ { print FILENAME ":" FNR }')

# Messages of a library do not name options of the tools: a tool adds the name of its own (Remedy).
while IFS= read -r place; do
  breach "$place" "names an option of a tool in a library"
done < <(sources modules | each '
    /^[[:space:]]*(\/\/|\*|\/\*)/ { next }
    { gsub(/\047\\?"\047/, "")  # the character, which begins no text
      for (rest = $0; match(rest, /"([^"\\]|\\.)*"/); rest = substr(rest, RSTART + RLENGTH)) {
        if (substr(rest, 1, RSTART - 1) ~ /\/\//) break
        text = substr(rest, RSTART, RLENGTH)
        if (text ~ /["(,;: \047`]--?[a-z][a-z_]+/) print FILENAME ":" FNR ": " text } }')

# Names that were replaced by the terms of the field do not come back.
replaced=$here/replaced_names.txt
[[ ! -e $replaced ]] || while IFS= read -r place; do
  breach "${place%% *}" "uses the name ${place#* } (replaced_names.txt)"
done < <(sources modules apps tests share | each '
  BEGIN {
    while ((getline line < "'"$replaced"'") > 0)
      if (line !~ /^#/ && split(line, pair, " ") == 2) instead[pair[1]] = pair[2]
  }
  FNR == 1 { comment = 0 }
  {
    code = $0
    gsub(/"([^"\\]|\\.)*"/, "\"\"", code)
    sub(/\/\/.*/, "", code)
    if (comment && !sub(/^.*\*\//, "", code)) next
    comment = 0
    gsub(/\/\*([^*]|\*[^\/])*\*\//, "", code)
    if (sub(/\/\*.*/, "", code)) comment = 1
    count = split(code, names, /[^A-Za-z0-9_]+/)
    for (i = 1; i <= count; ++i)
      if (names[i] in instead)
        print FILENAME ":" FNR " " names[i] " instead of " instead[names[i]]
  }')

# Headers for users are few, and so are the headers in folders internal/ that are installed because
# these include them.
users=$(find modules -path '*/include/*.h*' | wc -l)
((users <= 60)) || breach modules "installs $users headers for users, more than 60"
installed=$(mktemp -d)
cmake -DCMAKE_INSTALL_PREFIX="$installed" -DPCL_ALS_INTERNAL_INCLUDEDIR=internal \
  -DPCL_ALS_HEADER_FOLDERS="$(printf '%s;' "$PWD"/modules/*)" \
  -P "$here/../../share/cmake/pcl_als_internal_headers.cmake" >/dev/null
others=$(find "$installed" -type f | wc -l)
rm -rf -- "$installed"
((others <= 60)) || breach modules "the headers for users include $others others, more than 60"

# Every source file has a licence and at most 400 lines.
while IFS=$'\t' read -r file text; do
  breach "$file" "$text"
done < <({ sources modules apps tests share; find modules apps tests share -name '*.sh'; } | each '
  function ended() {
    if (!licensed) print file "\thas no SPDX line"
    if (lines > 400) print file "\thas " lines " lines, more than 400"
  }
  FNR == 1 { if (file) ended(); file = FILENAME; licensed = 0 }
  FNR <= 6 && /SPDX-License-Identifier: BSD-3-Clause/ { licensed = 1 }
  { lines = FNR }
  END { if (file) ended() }')

# Functions are short enough to be read at once.
while IFS=$'\t' read -r lines file line signature; do
  ((lines <= 57)) || breach "$file:$line" "a function of $lines lines, more than 57: $signature"
done < <(sources modules apps | each "$(<"$here/function_lengths.awk")")

# Every table of the glossary has the same columns.
if [[ -e share/GLOSSARY.md ]] && grep -B1 -E '^\|[-|]+\|$' share/GLOSSARY.md | grep -vE '^(--|\|-)' |
     grep -qvFx '| term | symbol | unit | definition | where used |'; then
  breach share/GLOSSARY.md "has a table without term, symbol, unit, definition and where used"
fi

# Every module page has the same sections.
while IFS=$'\t' read -r page section; do
  breach "$page" "has no section $section"
done < <(find modules -maxdepth 2 -name README.md | each '
  /^## / { has[FILENAME, $0] = 1 }
  END {
    count = split("Purpose Usage Method Limits Constants", sections, " ")
    for (a = 1; a < ARGC; ++a)
      for (i = 1; i <= count; ++i)
        if (!((ARGV[a], "## " sections[i]) in has)) print ARGV[a] "\t" sections[i]
  }')

# Lines of text in Markdown have less than 100 characters (tables may be wider).
while IFS= read -r place; do
  breach "$place" "has 100 characters or more"
done < <(find . -name '*.md' -not -path './.git/*' -not -path './build*' \
  -not -path './pcl_als_demo/*' -exec \
  awk '{ gsub(/[\200-\277]/, "") } length($0) > 99 && !/^\|/ { print FILENAME ":" FNR }' {} +)

# What a merge leaves where two changes meet.
while IFS= read -r place; do
  breach "$place" "is a mark of an unfinished merge"
done < <(grep -rnIoE --exclude-dir=.git --exclude-dir='build*' --exclude-dir=pcl_als_demo '^(<{7}|>{7}) ' .)

# One version in all files that state it.
if [[ -e CMakeLists.txt ]]; then
  version=$(sed -n 's/^project(pcl_als VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
  for file in CITATION.cff CHANGELOG.md share/packaging/vcpkg/vcpkg.json share/packaging/conda/meta.yaml; do
    [[ ! -e $file ]] || grep -qF -- "$version" "$file" || breach "$file" "does not name the version $version of CMakeLists.txt"
  done
fi

# A file that no CMakeLists.txt lists is not built.
declare -A lists
while IFS= read -r file; do
  list=${file%/*}
  until [[ -e $list/CMakeLists.txt ]]; do list=${list%/*}; done
  [[ -v "lists[$list]" ]] || lists[$list]=$(<"$list/CMakeLists.txt")
  name=${file##*/}
  [[ $file != share/* ]] || name=${name%.cpp}  # lists of the examples have no extensions
  [[ " ${lists[$list]//[(\/$'\n']/ }" == *" $name"* ]] ||
    breach "$file" "is not listed in $list/CMakeLists.txt"
done < <(find modules apps tests share/examples -name '*.cpp' | sort)

((breaches == 0)) || { echo "$breaches breaches of the architecture"; exit 1; }
echo "The modules keep to the architecture."
