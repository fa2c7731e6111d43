#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# The HTML pages of a calibration, a check and an intensity correction: their verdicts say what the
# JSON says, and a browser shows all of them without an error and without asking a network.
source "$(dirname -- "$0")/tool_test.sh"
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

# Every estimate of the JSON, rounded to the digits of the verdict, is the verdict's.
verdict_agrees() {  # PAGE_TEXT
  awk -v page="$1" '
    function value(line) { sub(/.*: /, "", line); sub(/,$/, "", line); return line }
    BEGIN {
      while ((getline line < page) > 0) { gsub(/−/, "-", line); text = text "\n" line }
      while ((getline line < "calibration.json") > 0) {
        if (line ~ /^  "[a-z_]+": \{/) { name = line; gsub(/[ ":{]/, "", name); gsub(/_/, " ", name) }
        if (line ~ /"bias":/) bias = value(line)
        if (line ~ /"std":/) std = value(line)
        if (line !~ /"status": "estimated"/) continue
        ++estimated
        start = index(text, toupper(substr(name, 1, 1)) substr(name, 2) ": ")
        if (!start) { print name " is not in the verdict"; bad = 1; continue }
        split(substr(text, start + length(name) + 2), words, " ")
        digits = index(words[1], ".") ? length(words[1]) - index(words[1], ".") : 0
        sub(/[^0-9]*$/, "", words[3])
        expected = sprintf("%." digits "f", bias)
        if (expected ~ /^-[0.]*$/) sub(/-/, "", expected)
        expected = expected " ± " sprintf("%." digits "f", std)
        if (words[1] " ± " words[3] != expected) {
          print name ": the page has " words[1] " ± " words[3] ", the JSON " expected; bad = 1
        }
      }
      if (estimated < 3) { print "only " estimated + 0 " estimates"; bad = 1 }
      exit bad
    }'
}
check "the verdict's numbers are the JSON's" verdict_agrees report/report.md


# The check before and after that calibration, and intensity as it was delivered.
expect 0 "report.html" check corrected/strip{1,2,3}.las -before "$block/strip1.las,$block/strip2.las,$block/strip3.las" \
  -control "$block/control.csv" -output quality.json -report check
expect 0 "report.html" intensity "${strips[@]}" -corrected intensity -trajectory "$block/trajectory.csv" \
  -estimate strip_gains -json intensity.json -report intensity_report
expect 2 "report" intensity "${strips[0]}" none.las -trajectory "$block/trajectory.csv" -report /proc/nowhere
absent none.las
for file in check/report.html check/report.md check/quality.md intensity_report/report.html intensity_report/report.md; do
  check "$file is there" test -s $file
done

# number INDENT SECTION KEY: of quality.json, in the sections of that indentation, one a line.
numbers() {
  awk -v head="$(printf '%*s' "$1" '')\"$2\": {" -v key="\"$3\":" '
    index($0, head) == 1 { on = 1; next }
    on && index($0, key) { sub(/.*: /, ""); sub(/,$/, ""); print; on = 0 }' quality.json
}
# in_cm METRES: as the verdict writes it.
in_cm() { awk -v m="$1" 'BEGIN { t = sprintf("%.1f", 100 * m); sub(/^-0\.0$/, "0.0", t); print t " cm" }'; }
worst=$(numbers 3 vertical rms_m | sort -g | tail -1) best=$(numbers 3 vertical rms_m | sort -g | head -1)
before=$(numbers 4 vertical rms_m | sort -g | tail -1)
control=$(numbers 2 all rms_m)
quality_agrees() {  # PAGE_TEXT
  local text part
  text=$(sed 's/−/-/g' "$1")
  for part in "an RMSDz of $(in_cm "$worst"), 8.0 cm are allowed" \
    "(RMSDz, level ground): $(in_cm "$best") to $(in_cm "$worst")" "to $(in_cm "$before");" \
    "fit control with an RMSE of $(in_cm "$control")"; do
    [[ $text == *"$part"* ]] || { echo "the page lacks '$part'"; return 1; }
  done
}
check "the verdict's numbers are quality.json's" quality_agrees check/report.md

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

# Plots of these very files.
expect 0 "heights.png" plot quality.json intensity.json -output plots
for name in heights offset_against_distance offset_against_time offset_against_scan_angle variance_to_mean \
  histograms strip_gains; do
  check "$name.png is drawn" test -s plots/$name.png
done

expect 1 "too small" plot quality.json -output plots -plots offset_against_distance -size 200x150

for page in report check intensity_report; do
  pictures=$(grep -o '<img ' $page/report.html | wc -l)
  check "$page has pictures" test "$pictures" -ge 4
  check "$page fetches nothing" eval '! grep -oE "(src|href)=\"[^\"]{0,40}" $page/report.html | grep -vE "\"data:(image/png;base64)?,"'
done

browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome)
if [[ -z $browser ]]; then
  echo "SKIPPED: the pages in a browser: chromium is not installed"
  finish
fi
# A copy with a script that reports what the browser made of the page.
cat >probe.html <<'END'
<script>
var errors = 0;
window.addEventListener('error', function () { ++errors; }, true);
window.addEventListener('load', function () {
  // Decoded to the last row: the corner of a picture is paper.
  function decoded(i) {
    var canvas = document.createElement('canvas');
    canvas.width = i.naturalWidth; canvas.height = i.naturalHeight;
    var context = canvas.getContext('2d');
    context.drawImage(i, 0, 0);
    return context.getImageData(canvas.width - 1, canvas.height - 1, 1, 1).data[3] == 255;
  }
  var images = Array.prototype.slice.call(document.images);
  var seen = images.filter(function (i) { return i.complete && i.naturalWidth == i.getAttribute('width') && decoded(i); });
  document.body.setAttribute('data-probe', 'errors=' + errors + ' images=' + seen.length + '/' + images.length +
    ' fetched=' + performance.getEntriesByType('resource').filter(function (r) { return !/^data:/.test(r.name); }).length +
    ' wide=' + (document.documentElement.scrollWidth > window.innerWidth));
  document.body.setAttribute('data-verdict', document.getElementById('verdict').innerText);
});
</script>
END
browse() {
  timeout 120 "$browser" --headless=new --no-sandbox --disable-gpu --disable-dev-shm-usage --no-first-run \
    --hide-scrollbars --window-size=1200,900 --enable-logging=stderr --user-data-dir="$scratch/browser" "$@" 2>browser.txt
}
shown() {  # PAGE CHECK_OF_NUMBERS
  local page=$1 pictures probe
  pictures=$(grep -o '<img ' "$page/report.html" | wc -l)
  awk '/<\/head>/ { while ((getline line < "probe.html") > 0) print line } { print }' "$page/report.html" >probed.html
  browse --virtual-time-budget=10000 --dump-dom "file://$scratch/probed.html" >dom.html
  probe=$(grep -oE 'data-probe="[^"]*"' dom.html)
  check "$page in the browser: $probe" test "$probe" = "data-probe=\"errors=0 images=$pictures/$pictures fetched=0 wide=false\""
  check "$page leaves the console empty" eval '! grep CONSOLE browser.txt'
  awk '/data-verdict="/ { on = 1 } on { print } on && /">/ { exit }' dom.html >shown.txt
  check "$page shows the JSON's numbers" "$2" shown.txt
}
shown report verdict_agrees
shown check quality_agrees
shown intensity_report intensity_agrees
browse --no-pdf-header-footer --print-to-pdf=page.pdf "file://$scratch/report/report.html" >/dev/null
check "the page prints" eval '[[ $(head -c 5 page.pdf) == %PDF- && $(wc -c <page.pdf) -gt 20000 ]]'
rm -rf -- "$scratch/browser"
finish
