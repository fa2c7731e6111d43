#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# Sourced by tests of HTML pages, in the folder of calibration.json and quality.json: whether a page's verdict has the
# numbers of the JSON, and what a browser ($browser) makes of it.

# Every estimate of the JSON, rounded to the digits of the verdict, is the verdict's.
verdict_agrees() {  # PAGE_TEXT
  awk -v page="$1" '
    function value(line) { sub(/.*: /, "", line); sub(/,$/, "", line); return line }
    BEGIN {
      while ((getline line < page) > 0) { gsub(/−/, "-", line); text = text "\n" line }
      while ((getline line < "calibration.json") > 0) {
        if (line ~ /^   "[a-z_]+": \{/) { name = line; gsub(/[ ":{]/, "", name); gsub(/_/, " ", name) }
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

# number INDENT SECTION KEY: of quality.json, in the sections of that indentation, one a line.
numbers() {
  awk -v head="$(printf '%*s' "$1" '')\"$2\": {" -v key="\"$3\":" '
    index($0, head) == 1 { on = 1; next }
    on && index($0, key) { sub(/.*: /, ""); sub(/,$/, ""); print; on = 0 }' quality.json
}
# in_cm METRES: as the verdict writes it.
in_cm() { awk -v m="$1" 'BEGIN { t = sprintf("%.1f", 100 * m); sub(/^-0\.0$/, "0.0", t); print t " cm" }'; }
quality_agrees() {  # PAGE_TEXT
  local text part worst best before control
  worst=$(numbers 3 vertical rms_m | sort -g | tail -1)
  best=$(numbers 3 vertical rms_m | sort -g | head -1)
  before=$(numbers 4 vertical rms_m | sort -g | tail -1)
  control=$(numbers 2 all rms_m)
  text=$(sed 's/−/-/g' "$1")
  for part in "an RMSDz of $(in_cm "$worst"), 8.0 cm are allowed" \
    "(RMSDz, level ground): $(in_cm "$best") to $(in_cm "$worst")" "to $(in_cm "$before");" \
    "fit control with an RMSE of $(in_cm "$control")"; do
    [[ $text == *"$part"* ]] || { echo "the page lacks '$part'"; return 1; }
  done
}

# A copy with a script that reports what the browser made of the page.
cat >"$scratch/probe.html" <<'END'
<script>
var errors = 0;
window.addEventListener('error', function () { ++errors; }, true);
window.addEventListener('load', function () {
  // A picture is complete where all its texts lie inside it.
  function complete(picture) {
    var frame = picture.getBoundingClientRect();
    return frame.width > 0 && Array.prototype.every.call(picture.querySelectorAll('text'), function (text) {
      var box = text.getBoundingClientRect();
      return box.width > 0 && box.left >= frame.left - 1 && box.right <= frame.right + 1 &&
        box.top >= frame.top - 1 && box.bottom <= frame.bottom + 1;
    });
  }
  var pictures = Array.prototype.slice.call(document.querySelectorAll('figure > svg'));
  document.body.setAttribute('data-probe', 'errors=' + errors + ' pictures=' +
    pictures.filter(complete).length + '/' + pictures.length +
    ' fetched=' + performance.getEntriesByType('resource').filter(function (r) { return !/^data:/.test(r.name); }).length +
    ' wide=' + (document.documentElement.scrollWidth > window.innerWidth));
  document.body.setAttribute('data-verdict', document.getElementById('verdict').innerText);
});
</script>
END
browse() {
  timeout 120 "$browser" --headless=new --no-sandbox --disable-gpu --disable-dev-shm-usage --no-first-run \
    --hide-scrollbars --enable-logging=stderr --user-data-dir="$scratch/browser" "$@" 2>browser.txt
}
shown() {  # PAGE CHECK_OF_NUMBERS
  local page=$1 pictures probe
  pictures=$(grep -o '<svg width' "$page/report.html" | wc -l)
  awk -v probe="$scratch/probe.html" '/<\/head>/ { while ((getline line < probe) > 0) print line } { print }' \
    "$page/report.html" >"$scratch/probed.html"
  browse --window-size=1200,900 --virtual-time-budget=10000 --dump-dom "file://$scratch/probed.html" >dom.html
  probe=$(grep -oE 'data-probe="[^"]*"' dom.html)
  check "$page in the browser: $probe" test "$probe" = "data-probe=\"errors=0 pictures=$pictures/$pictures fetched=0 wide=false\""
  check "$page leaves the console empty" eval '! grep CONSOLE browser.txt'
  awk '/data-verdict="/ { on = 1 } on { print } on && /">/ { exit }' dom.html >shown.txt
  check "$page shows the JSON's numbers" "$2" shown.txt
}
