#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# Help, version and wrong usage of every tool.
source "$(dirname -- "$0")/tool_test.sh"

for tool in "$bin"/pcl_als_*; do
  verb=${tool##*/pcl_als_}
  for help in -h -help --help; do
    expect 0 "Usage: pcl_als_$verb*Options (one dash or two):*--threads*Example:*Exit status:" "$verb" $help
  done
  mv out.txt "help_$verb.txt"
  "$tool" -list_options >"options_$verb.txt"
  for version in -version --version; do expect 0 "pcl_als_$verb [0-9]*.[0-9]*.[0-9]" "$verb" $version; done
  expect 1 "bogus" "$verb" -bogus 1
  expect 1 "bogus" "$verb" --bogus=1
  expect 1 "threads" "$verb" -threads
  expect 1 "threads" "$verb" -threads many
  expect 1 "threads" "$verb" -threads -2
done

# The text of every option speaks of options that the tool has, and is whole on the manual page.
texts() {  # VERB: the name and the text of every option, as -h prints them
  awk '/^Options/ { on = 1; next } /^Example/ { on = 0 } /^[A-Z]/ { next }
    on && /^  --/ { if (name != "") print name "\t" text; name = $1; text = ""; sub(/^  --[^ ]+/, "")
                    if (!sub(/^.*  +/, "")) next }
    on && NF { sub(/^ +/, ""); text = text (text == "" ? "" : " ") $0 }
    END { print name "\t" text }' "help_$1.txt"
}
# wrong_texts NAMES PAGE TEXTS: options without a text, with one that speaks of an option that is not among the
# names, and with another one on the manual page.
wrong_texts() {
  awk -F'\t' '
    FILENAME == ARGV[1] { known["-" $1] = 1; next }
    FILENAME == ARGV[2] {
      if (sub(/^\.B \\-/, "")) { name = "--" $0; sub(/ .*/, "", name) }
      else if (/^\./) name = ""
      else if (name != "") {
        sub(/\\&/, ""); gsub(/\\-/, "-"); gsub(/\\e/, "\\")
        shown[name] = shown[name] $0
      }
      next
    }
    $2 == "" { print $1 " has no text" }
    shown[$1] != $2 { print "the manual page has \047" shown[$1] "\047 for " $1 ", not \047" $2 "\047" }
    {
      for (rest = " " $2; match(rest, /[ (,;]-[a-z][a-z_]*/); rest = substr(rest, RSTART + RLENGTH)) {
        other = substr(rest, RSTART + 1, RLENGTH - 1)
        if (!(other in known)) print $1 " speaks of " other
      }
    }' "$@"
}
man_page=$here/../../share/cmake/man_page.awk
for tool in "$bin"/pcl_als_*; do
  verb=${tool##*/pcl_als_}
  texts "$verb" >texts.txt
  awk -v tool="pcl_als_$verb" -v version=1 -v manual=page -f "$man_page" "help_$verb.txt" >"page_$verb.1"
  awk -F'\t' 'NR > 1 && $1 != "IN" && $1 != "OUT" { print $1 } END { print "h" }' "options_$verb.txt" >names.txt
  checks=$((checks + 1))
  while IFS= read -r wrong; do failed "pcl_als_$verb: $wrong"; done < <(wrong_texts names.txt "page_$verb.1" texts.txt)
  [[ $(($(wc -l <texts.txt) + 1)) == $(wc -l <names.txt) ]] || failed "pcl_als_$verb: -h and -list_options differ"
done

# The parts of -h are those of the manual page, and -list_options names the part of each option.
for tool in "$bin"/pcl_als_*; do
  verb=${tool##*/pcl_als_}
  awk '/^Options/ { on = 1; next } /^Example/ { on = 0 } on && /^[A-Z].*:$/ { sub(/:$/, ""); print }' "help_$verb.txt" >parts.txt
  check "parts of the manual page of $verb" cmp parts.txt <(sed -n 's/^\.SS //p' "page_$verb.1")
  check "parts of $verb are listed" test "$(awk -F'\t' 'NR == 1 && $9 == "group" { named = 1 }
      NR > 1 && $1 != "IN" && $1 != "OUT" { seen[$9] }
      END { print named ? length(seen) : "none" }' "options_$verb.txt")" == "$(wc -l <parts.txt)"
done
check "needed options first" test "$("$bin/pcl_als_calibrate" -h | grep -A1 '^Output:' | grep -o -- '--[a-z]*')" == --output

# Names that options had before are accepted with a remark, and no tool lists them.
checks=$((checks + 2))
run info "$block/strip1.las" -json former.json
[[ $status == 0 && -s former.json && $(<err.txt) == "pcl_als_info: option -json is now called -output; the next"* ]] ||
  failed "a former name: status $status"
run icpatch a.las b.las -output x.json -pairs 500
[[ $status == 1 && $(<err.txt) == *"option -candidates: '0.5' is not a number from 1 to 100000 thousands" ]] ||
  failed "a former name with another unit: status $status"

# Options that are needed are missed before a file is read.
expect 1 "option -output is needed" trajectory "$block/control.csv"
expect 1 "option -output is needed" trajectory -trajectory none.csv
expect 1 "option -output is needed" lines none.las
expect 1 "option -trajectory is needed" apply none.las x.las -calibration none.json
expect 1 "options -output and -grids is needed" classify none.las -training none.csv
expect 1 "options -output and -window is needed" view none.las

# Options without an effect are refused.
expect 1 "option -own needs -systems" calibrate none.las -trajectory none.csv -output c.json -own offset
expect 1 "option -fixed_sigma needs -fixed" calibrate none.las -trajectory none.csv -output c.json -fixed_sigma 0.1
expect 1 "option -control_sigma needs -control" calibrate none.las -trajectory none.csv -output c.json -control_sigma 0.1
expect 1 "option -uncertainty_cell needs -uncertainty_raster" apply none.las x.las -trajectory none.csv -bias range_bias=1 -uncertainty_cell 5
expect 1 "options -terrain and -ground_slope exclude each other" plan -lines none.csv -terrain none.asc -ground_slope 3
expect 1 "option -strip_corrections needs -corrected" calibrate none.las -trajectory none.csv -output c.json -strip_corrections

# Dashes in names, words of the command in a file, folders of point files.
expect 1 "option -strip_corrections needs -corrected" calibrate none.las -trajectory none.csv -output c.json \
  --strip-corrections
expect 1 "option -cell: '-1' is not a number" info "$block" --cell=-1
mkdir -p 'a folder/nested' none && cp "$block"/strip[12].las 'a folder' && cp "$block/strip3.las" 'a folder/nested'
printf '# two strips\n"a folder/strip1.las"\t%s -output @name.json # as it is\n' "'a folder'/strip2.las" >words.txt
expect 0 "2 files" info @words.txt
check "a word that begins with @ in the file" test -s @name.json
expect 0 "2 files" info 'a folder'
expect 0 "3 strips" info 'a folder' 'a folder/nested' -cell 20
expect 2 "none: " info none
expect 1 "given twice" info 'a folder' 'a folder/strip1.las'
expect 2 "none.txt: cannot be opened: there is no such file" info @none.txt
printf '"open' >open.txt
expect 1 "open.txt: a quote is not closed" info @open.txt
printf 'a\0b' >zero.txt
expect 2 "zero.txt: is no text, because it has a zero byte" info @zero.txt

# Completion in the shell.
completion=$bin/../completions
checks=$((checks + 1))
completed() {  # WORD…: what bash offers for the last one
  bash -c 'source "$1/pcl_als_apply"; COMP_WORDS=("${@:2}"); COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
    _pcl_als_apply && printf "%s\n" "${COMPREPLY[@]}"' bash "$completion" "$@" | sort | tr '\n' ' '
}
[[ $(completed pcl_als_apply -unc) == "-uncertainty -uncertainty_cell -uncertainty_raster " ]] ||
  failed "completion of an option: $(completed pcl_als_apply -unc)"
checks=$((checks + 1))
[[ $(completed pcl_als_apply x.las -model quas) == "quasi_rigorous " ]] || failed "completion of a word"
checks=$((checks + 1))
[[ $(completed pcl_als_apply 'a folder/str') == "a folder/strip1.las a folder/strip2.las " ]] ||
  failed "completion of a file: $(completed pcl_als_apply 'a folder/str')"
for tool in "$bin"/pcl_als_*; do check "completion of $tool" test -s "$completion/${tool##*/}"; done

for tool in apply calibrate info; do expect 1 "usage: pcl_als_$tool" "$tool"; done

# A misspelt option is answered with the nearest one, where there is one.
expect 1 "trajctory'; did you mean -trajectory?" calibrate -trajctory x
expect 1 "did you mean -trajectory?" apply -traject x  # not -trajectory_units, which continues it
expect 1 "did you mean -strip_corrections?" calibrate -strip-correction
expect 1 "did you mean -output?" calibrate -outptu x.json
expect 1 "did you mean -quality_level?" check --qualitylevel=2
check "no suggestion for what is near nothing" sh -c \
  "! '$bin/pcl_als_info' -zzzzzz 2>&1 | grep -q 'did you mean'"

# What cannot be written to stdout is an error; closed streams and FIFOs do no harm.
full() {  # VERB ARG…: the tool ends with status 2 and one line when stdout is full
  checks=$((checks + 1))
  status=0
  "$bin/pcl_als_$1" "${@:2}" >/dev/full 2>err.txt || status=$?
  [[ $status == 2 && $(<err.txt) == "pcl_als_$1: cannot write to standard output"* ]] ||
    failed "$1 > /dev/full: status $status"
}
full info "$block/strip1.las"
for tool in "$bin"/pcl_als_*; do full "${tool##*/pcl_als_}" -h; done
closed() { "$bin/pcl_als_info" "$block/strip1.las" -output closed.json <&- >&- 2>&-; }
check "closed standard streams" closed
check "the output is whole" grep -q '"strips"' closed.json
mkfifo pipe.las
checks=$((checks + 1))
status=0
timeout 10 "$bin/pcl_als_info" pipe.las >out.txt 2>err.txt || status=$?
[[ $status == 2 && $(<err.txt) == *"pipe.las: is a pipe"* ]] || failed "a FIFO: status $status"
expect 1 "given twice" info "$block/strip1.las" "$block/../block/strip1.las"
expect 1 "output" simulate
expect 1 "preset" simulate -output x -preset huge
expect 1 "scale" simulate -output x -scale 0
expect 1 "scale" simulate -output x -scale nan
expect 1 "noise" simulate -output x -noise loud
expect 1 "boresight_rol" simulate -output x -bias boresight_rol=3
expect 1 "usage" simulate -output x a.las
absent x
strip=$block/strip1.las
expect 1 "trajectory" apply "$strip" x.las -bias range_bias=0.1
expect 1 "calibration and -bias" apply "$strip" x.las -trajectory "$block/trajectory.csv"
expect 1 "range_bia" apply "$strip" x.las -trajectory "$block/trajectory.csv" -bias range_bia=0.1
expect 1 "range_bias" apply "$strip" x.las -trajectory "$block/trajectory.csv" -bias range_bias=1e9
expect 1 "usage" apply "$strip" x.las y.las -trajectory "$block/trajectory.csv" -bias range_bias=0.1
absent x.las y.las
two=("$block/strip1.las" "$block/strip2.las" -trajectory "$block/trajectory.csv")
expect 1 "output" calibrate "${two[@]}"
expect 1 "trajectory" calibrate "$block/strip1.las" "$block/strip2.las" -output x.json
expect 1 "wobble" calibrate "${two[@]}" -output x.json -estimate boresight_roll,wobble
expect 1 "pairs" calibrate "${two[@]}" -output x.json -pairs 1-2
expect 1 "model" calibrate "${two[@]}" -output x.json -model perfect
expect 1 "-vertical exclude each other" calibrate "${two[@]}" -output x.json -model rigorous -vertical
expect 1 "-line_fit: '1e9' is not a number from 0.001 to 60 s" calibrate "${two[@]}" -output x.json -line_fit 1e9
expect 1 "scan_angle_scale: -1 is not between -0.1 and 0.1" apply "$strip" x.las -trajectory "$block/trajectory.csv" \
  -bias scan_angle_scale=-1
absent x.json
finish
