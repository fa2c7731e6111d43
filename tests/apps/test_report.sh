#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# The HTML page of a calibration: its verdict says what calibration.json says, and a browser shows
# all of it without an error and without asking a network.
source "$(dirname -- "$0")/tool_test.sh"
unset DISPLAY
strips=("$block"/strip*.las)
arguments=("${strips[@]}" -trajectory "$block/trajectory.csv" -control "$block/control.csv"
           -output calibration.json -report report)
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

pictures=$(grep -o '<img ' report/report.html | wc -l)
check "the page has pictures" test "$pictures" -ge 5
check "nothing is fetched" eval '! grep -oE "(src|href)=\"[^\"]{0,40}" report/report.html | grep -vE "\"data:(image/png;base64)?,"'

browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome)
if [[ -z $browser ]]; then
  echo "SKIPPED: the page in a browser: chromium is not installed"
  finish
fi
# A copy with a script that reports what the browser made of the page.
cat >probe.html <<'END'
<script>
var errors = 0;
window.addEventListener('error', function () { ++errors; }, true);
window.addEventListener('load', function () {
  var images = Array.prototype.slice.call(document.images);
  var seen = images.filter(function (i) { return i.complete && i.naturalWidth == i.getAttribute('width'); });
  document.body.setAttribute('data-probe', 'errors=' + errors + ' images=' + seen.length + '/' + images.length +
    ' fetched=' + performance.getEntriesByType('resource').filter(function (r) { return !/^data:/.test(r.name); }).length +
    ' wide=' + (document.documentElement.scrollWidth > window.innerWidth));
  document.body.setAttribute('data-verdict', document.getElementById('verdict').innerText);
});
</script>
END
awk '/<\/head>/ { while ((getline line < "probe.html") > 0) print line } { print }' report/report.html >probed.html
browse() {
  timeout 120 "$browser" --headless=new --no-sandbox --disable-gpu --disable-dev-shm-usage --no-first-run \
    --hide-scrollbars --window-size=1200,900 --user-data-dir="$scratch/browser" "$@" 2>browser.txt
}
browse --virtual-time-budget=10000 --dump-dom "file://$scratch/probed.html" >dom.html
probe=$(grep -oE 'data-probe="[^"]*"' dom.html)
check "in the browser: $probe" test "$probe" = "data-probe=\"errors=0 images=$pictures/$pictures fetched=0 wide=false\""
awk '/data-verdict="/ { on = 1 } on { print } on && /">/ { exit }' dom.html >shown.txt
check "the numbers that are shown are the JSON's" verdict_agrees shown.txt
browse --no-pdf-header-footer --print-to-pdf=page.pdf "file://$scratch/report/report.html" >/dev/null
check "the page prints" eval '[[ $(head -c 5 page.pdf) == %PDF- && $(wc -c <page.pdf) -gt 20000 ]]'
rm -rf -- "$scratch/browser"
finish
