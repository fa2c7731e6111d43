#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# The HTML pages of a calibration, a check and an intensity correction: their verdicts say what the
# JSON says, and a browser shows all of them without an error and without asking a network.
source "$(dirname -- "$0")/tool_test.sh"
source "$here/report_page.sh"
unset DISPLAY
strips=("$block"/strip*.las)
arguments=("${strips[@]}" -trajectory "$block/trajectory.csv" -control "$block/control.csv"
           -output calibration.json -corrected corrected -report report)
run calibrate "${arguments[@]}"
[[ $status == 0 || $status == 3 ]] || failed "calibrate: exit status $status"
for file in report.html report.md parameters.csv pairs.csv iterations.csv areas.csv; do
  check "report/$file is there" test -s report/$file
done
expect 2 "report" calibrate "${arguments[@]::${#arguments[@]}-1}" /proc/nowhere

check "the verdict's numbers are the JSON's" verdict_agrees report/report.md


# The check before and after that calibration, and intensity as it was delivered.
expect 0 "report.html" check corrected/strip{1,2,3}.las -before "$block/strip1.las,$block/strip2.las,$block/strip3.las" \
  -control "$block/control.csv" -output quality.json -report check -title "Mission <7>"
check "the page has its title" grep -q "<h1>Mission &lt;7&gt;</h1>" check/report.html
expect 1 "title" check "${strips[@]}" -output none.json -title "no report"
expect 0 "report.html" intensity "${strips[@]}" -corrected intensity -trajectory "$block/trajectory.csv" \
  -estimate strip_gains -output intensity.json -report intensity_report
expect 2 "report" intensity "${strips[0]}" none.las -trajectory "$block/trajectory.csv" -report /proc/nowhere
absent none.las
for file in check/report.html check/report.md check/quality.md intensity_report/report.html intensity_report/report.md; do
  check "$file is there" test -s $file
done

check "the verdict's numbers are quality.json's" quality_agrees check/report.md

# What a report holds is what its tool declares; it is made anew as long as nobody changed it.
declared() {  # VERB FOLDER: every file in the folder of -report is among those that the tool names
  local file words
  words=$("$bin/pcl_als_$1" -list_options | awk -F'\t' '$1 == "report" { print $8 }')
  for file in "$2"/*; do
    [[ ,$words, == *",${file##*/},"* ]] || { echo "$1 -list_options does not name $file"; return 1; }
  done
}
check "the files of a calibration's report" declared calibrate report
check "the files of a check's report" declared check check
check "the files of an intensity report" declared intensity intensity_report
again=(corrected/strip{1,2}.las -control "$block/control.csv" -output again.json)
mkdir mine
cp "$block/control.csv" mine/control.csv
expect 1 "mine/control.csv is also an input (-control); name another folder" check "${again[@]::2}" \
  -control mine/control.csv -output again.json -report mine
expect 1 "mine/control.csv: would be replaced" check "${again[@]}" -report mine
check "the user's control points are still there" cmp "$block/control.csv" mine/control.csv
for time in first second; do expect 0 "report.html" check "${again[@]}" -report again; done
cp "$block/control.csv" again/control.csv
expect 1 "again/control.csv: would be replaced" check "${again[@]}" -report again
check "the user's control points are still there" cmp "$block/control.csv" again/control.csv

# The medians and ratios of the intensity's JSON.
value_after() {  # PATTERN… : the value of the first line that matches the last, after the others in turn
  awk -v patterns="$(printf '%s\n' "$@")" 'BEGIN { n = split(patterns, wanted, "\n"); at = 1 }
    index($0, "\"" wanted[at] "\":") { if (at++ == n) { sub(/.*: /, ""); sub(/,$/, ""); print; exit } }' intensity.json
}
percent() { awk -v v="$1" 'BEGIN { printf "%.1f %%", 100 * v }'; }
two() { awk -v v="$1" 'BEGIN { printf "%.2f", v }'; }
intensity_agrees() {  # PAGE_TEXT
  local text part b a
  text=$(<"$1")
  b=$(value_after report all before variance_to_mean) a=$(value_after report all after variance_to_mean)
  for part in "differ by $(percent "$(value_after coefficient_of_variation after median)")" \
    "($(percent "$(value_after coefficient_of_variation before median)") as received)" \
    "goes from $(two "$b") to $(two "$a")"; do
    [[ $text == *"$part"* ]] || { echo "the page lacks '$part'"; return 1; }
  done
}
check "the verdict's numbers are intensity.json's" intensity_agrees intensity_report/report.md

# A trajectory from points: the path on a map with its uncertainty, the rays, and what determined it.
expect 0 '' trajectory "${strips[@]}" -positions -output path.csv -report trajectory_report
check "the trajectory's verdict" grep -q "The trajectory of 5 of 5 passes was found" trajectory_report/report.md
trajectory_page() {  # LINES_OF_THE_TOOL PAGE_TEXT: standard deviations and rays of each strip
  awk 'NR == FNR { if (/^  strip .* m above ground/) { sub(":", "", $2); std[$2] = $12 " | " $13 " | " $14
                   for (i = 1; i <= NF; ++i) if ($i == "rays,") rays[$2] = $(i - 1); ++strips }; next }
    /^\| strip/ { table = /evidence/ ? "paths" : /excluded/ ? "rays" : "" }
    table == "paths" && $2 in std { if (index($0, std[$2]) && / rays \|$/) ++found }
    table == "rays" && $2 in rays { split($0, cell, " \\| "); if (cell[2] - cell[3] == rays[$2]) ++found }
    END { exit !(strips == 5 && found == 10) }' "$1" "$2"
}
expect 0 'm above ground' trajectory "${strips[@]}" -positions -output path.csv
cp out.txt stated.txt
check "the page has the paths and rays that the tool states" trajectory_page stated.txt trajectory_report/report.md
for words in "The path of the sensor (black)" "Standard deviations of the position over time" \
  "Distances of the rays from the path over their standard deviations"; do
  check "a picture of: $words" grep -q "$words" trajectory_report/report.html
done

check "the files of a trajectory's report" declared trajectory trajectory_report

# Plots of these very files.
expect 0 "heights.png" plot quality.json intensity.json -output plots
for name in heights offset_against_distance offset_against_time offset_against_scan_angle variance_to_mean \
  histograms strip_gains; do
  check "$name.png is drawn" test -s plots/$name.png
done

expect 1 "too small" plot quality.json -output plots -plots offset_against_distance -size 200x150

for page in report check intensity_report trajectory_report; do
  pictures=$(grep -o '<svg width' $page/report.html | wc -l)
  check "$page has pictures" test "$pictures" -ge "$([[ $page == trajectory_report ]] && echo 3 || echo 4)"
  check "$page fetches nothing" eval '! grep -oE "(src|href)=\"[^\"]{0,40}" $page/report.html | grep -vE "\"data:(image/png;base64)?,|\"#section"'
done

browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome)
if [[ -z $browser ]]; then
  echo "SKIPPED: the pages in a browser: chromium is not installed"
  finish
fi
# On narrow, usual and wide screens nothing but tables scrolls to the side.
narrow() {  # PAGE
  local width
  for width in 400 800 1920; do
    browse --window-size=$width,900 --virtual-time-budget=10000 --dump-dom "file://$scratch/probed.html" >dom.html
    check "$1 at $width pixels" grep -q ' wide=false"' dom.html
  done
}
shown report verdict_agrees
narrow report
shown check quality_agrees
narrow check
shown intensity_report intensity_agrees
browse --no-pdf-header-footer --print-to-pdf=page.pdf "file://$scratch/report/report.html" >/dev/null
check "the page prints" eval '[[ $(head -c 5 page.pdf) == %PDF- && $(wc -c <page.pdf) -gt 20000 ]]'
rm -rf -- "$scratch/browser"
finish
