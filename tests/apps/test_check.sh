#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# pcl_als_check: wrong usage, strips that cannot be compared, what it writes, and the simulated block
# before and after its calibration.
source "$(dirname -- "$0")/tool_test.sh"
strips=("$block"/strip?.las)
one=${strips[0]} two=${strips[1]}

expect 1 "usage" check -output x.json
expect 1 "output" check "$one" "$two"
expect 1 "quality_level" check "$one" "$two" -output x.json -quality_level 4
expect 1 "max_distance" check "$one" "$two" -output x.json -max_distance 0
expect 1 "unrecognised option '-sigma'" check "$one" "$two" -output x.json -sigma 1
expect 1 "given twice" check "$one" "$two" "$block/./strip1.las" -output x.json
expect 2 "the folder does not exist" check "$one" "$two" -output nowhere/x.json
expect 2 "no folder" check "$one" "$two" -output x.json -report "$one/report"
expect 2 "missing.las" check "$one" missing.las -output x.json
expect 2 "missing.csv" check "$one" "$two" -control missing.csv -output x.json
mkdir empty
expect 2 "empty holds no point files" check "$one" "$two" -before empty -output x.json
awk -F, -v OFS=, 'NR > 1 { $1 += 50000 } { print }' "$block/trajectory.csv" >other_time.csv
expect 2 "time" check "$one" "$two" -trajectory other_time.csv -output x.json
expect 2 "fewer than two strips" check "$one" -output x.json
absent x.json

# pcd ID EAST POINTS_PER_ROW ROWS: an ascii cloud on a rolling plane, 1 m apart.
pcd() {
  awk -v id="$1" -v east="$2" -v columns="$3" -v rows="$4" 'BEGIN {
    n = columns * rows
    print "VERSION .7\nFIELDS x y z intensity gps_time point_source_id"
    print "SIZE 4 4 4 4 8 2\nTYPE F F F F F U\nCOUNT 1 1 1 1 1 1"
    print "WIDTH " n "\nHEIGHT 1\nVIEWPOINT 690000 5330000 0 1 0 0 0\nPOINTS " n "\nDATA ascii"
    for (r = 0; r < rows; r++) for (c = 0; c < columns; c++) {
      x = east + c + 0.3 * sin(7 * r + 3 * c + id); y = r + 0.3 * cos(5 * r + 11 * c + id)
      printf "%.3f %.3f %.3f 100 %.4f %d\n", x, y, 0.2 * sin(x / 9) + 0.01 * id, 1000 * id + r / 60, id } }'
}
pcd 1 0 60 60 >a.pcd; pcd 2 0 60 60 >b.pcd; pcd 3 59 60 60 >edge.pcd; pcd 4 500 60 60 >far.pcd
pcd 5 20 1 1 >point.pcd
sed '/^DATA/,$s/ 1$/ 9/' a.pcd >copy.pcd

expect 2 "no two strips overlap" check a.pcd far.pcd -output x.json
absent x.json
expect 2 "fewer than two strips" check a.pcd point.pcd -output x.json
absent x.json
# Hardly in common: an answer that cannot be relied on is written and says why.
expect 3 "1 and 3: only" check a.pcd edge.pcd -output edge.json
check "edge.json is written" grep -q '"status": "too_little"' edge.json
expect 3 "copy" check a.pcd copy.pcd -output copy.json
check "a copy is called one" grep -q '"status": "copy"' copy.json
# A strip at another height overlaps, but nothing can be compared: the pair is named with the offset.
awk '/^DATA/ { data = 1; print; next } data { $3 += 50; $6 = 6 } { print }' b.pcd >lifted.pcd
expect 3 "1 and 6: only 0 places*50 in 3 cells of 25 m are required*strip 1 lies 50.0? m below strip 6" check a.pcd lifted.pcd -output lifted.json
check "the offset is among the warnings" grep -q 'strips 1 and 6 overlap, but strip 1 lies 50.0. m below strip 6.*; -max_distance compares' lifted.json
expect 0 "1 & 2" check a.pcd b.pcd lifted.pcd -output lifted.json
# A required level is kept or not: exit status and a field of the result, for a batch.
expect 0 "" check a.pcd b.pcd -require QL2 -output kept.json
check "kept.json says so" grep -q '"kept": true' kept.json
expect 3 "does not keep QL1: strips 1 and 6: too far apart" check a.pcd b.pcd lifted.pcd -require QL1 -output missed.json
check "missed.json says so" awk '/"requirement"/ { found = 1 } /"required_level": "QL1"/ { level = 1 }
  found && level && /"kept": false/ { kept = 1 } /"strips 2 and 6: too far apart/ { reason = 1 }
  END { exit !(kept && reason) }' missed.json
awk '/^DATA/ { data = 1; print; next } data { $3 += 0.12; $6 = 7 } { print }' b.pcd >high.pcd
expect 3 "does not keep QL2: strips 1 and 7: RMSDz 1*.* cm, more than the 8 cm that are allowed" check a.pcd high.pcd -require QL2 -output high.json
expect 0 "0 of 1 pairs keep QL2" check a.pcd high.pcd -output high.json
check "without -require the field states it as well" grep -q '"kept": false' high.json
expect 0 "" check a.pcd high.pcd -require QL3 -output high.json
# Two flights, 2.3 m apart: each agrees in itself, and every overlapping pair is counted.
for k in a:8 b:9; do
  awk -v id="${k#*:}" '/^DATA/ { data = 1; print; next } data { $3 += 2.3; $6 = id } { print }' \
    "${k%:*}.pcd" >"flight${k#*:}.pcd"
done
expect 0 "2 of 6 pairs keep QL2*4 overlapping pairs lie too far apart in height*1 and 8 (2.30 m)" \
  check a.pcd b.pcd flight8.pcd flight9.pcd -output flights.json
check "the JSON counts them" grep -q '"too_far": 4' flights.json
expect 3 "does not keep QL2: strips 1 and 8: too far apart" check a.pcd b.pcd flight8.pcd \
  flight9.pcd -require QL2 -output flights.json
# Control: far from all strips it is a figure and not a class; a figure of no points is none.
plane() { awk -v up="$1" 'BEGIN { print "id,x,y,z"; for (i = 0; i < 18; i++) {
  x = 8 + 8 * (i % 6); y = 8 + 16 * int(i / 6)
  printf "G%d,%.3f,%.3f,%.3f\n", i, 690000 + x, 5330000 + y, 0.2 * sin(x / 9) + 0.01 + up } }'; }
plane 1.5 >control_high.csv; plane 0 >control_good.csv
plane 0 | awk -F, -v OFS=, 'NR > 1 { $2 += 40000 } { print }' >control_aside.csv
plane 0 | awk -F, -v OFS=, 'NR == 5 { $4 += 4 } { print }' >control_blunder.csv
expect 0 "RMSE_V 0.0* m (class * cm)" check a.pcd b.pcd -control control_good.csv -output good.json
expect 0 "18 points, 0 of no strip, 18 more than 1 m*RMSE_V 1.*no class: 18 of 18 control points lie more than 1 m*the strips lie 1.49 ± 0.01 m below all 18 control points: check the antenna height" \
  check a.pcd b.pcd -control control_high.csv -output high.json
check "there is no class in the JSON" grep -q '"class_cm": null' high.json
expect 3 "does not keep QL3*18 of 18 control points" check a.pcd b.pcd -control control_high.csv \
  -require QL3 -output high.json
expect 0 "17 points, 0 of no strip, 1 more than 1 m*class*G3 (-*blunders" check a.pcd b.pcd \
  -control control_blunder.csv -output blunder.json
expect 0 "0 points, 18 of no strip: no figures*no strip covers any of 18 control points, which lie 3*km beside" \
  check a.pcd b.pcd -control control_aside.csv -output aside.json
expect 3 "no reliable answer" check a.pcd copy.pcd -require QL3 -output copy.json
expect 1 "QL0, QL1, QL2" check a.pcd b.pcd -require 2 -output x.json
expect 1 "different levels" check a.pcd b.pcd -require QL2 -quality_level 1 -output x.json
# An SBET needs a CRS, which these files do not state: the option that does is named.
head -c 272 /dev/zero >flight.sbet
expect 1 'name no CRS*give one with -crs' check a.pcd b.pcd -trajectory flight.sbet -output q.json
check "a lifted strip is named beside good ones" grep -q 'strips 2 and 6 overlap, but strip 2 lies' lifted.json
# Strips that cannot be compared do not keep the others from it.
expect 0 "1 & 2" check a.pcd b.pcd edge.pcd point.pcd -output some.json
check "a strip of one point is named" grep -q 'strip 5 has only 1 point' some.json
check "a pair at the edge is listed" grep -q '"too_little"' some.json
check "the offset of 1 cm is found" awk '/"mean_m"/ { gsub(/[^-0-9.e]/, "", $2)
  exit !($2 + 0 < -0.008 && $2 + 0 > -0.012) }' some.json
# Points that are there twice, as a file under two names makes them.
cp "$one" again.las
expect 0 "is a file given twice" check "$one" again.las "$two" -output x.json

# One strip and control; a report; nothing printed when quiet.
expect 0 "RMSE_V" check "$one" -control "$block/control.csv" -output control.json
expect 0 "" check "${strips[@]}" -control "$block/control.csv" -trajectory "$block/trajectory.csv" \
  -output quality.json -report report -quiet
[[ ! -s out.txt ]] || failed "-quiet prints"
for file in quality.md pairs.csv slope_aspect.csv profiles.csv offsets.csv control.csv run.csv; do
  check "report/$file is there" test -s "report/$file"
done
if compgen -G "report/*.tif" >/dev/null; then  # built with GDAL
  check "the image is there" test -s report/swath_separation.tif -a -s report/swath_separation.png
fi
columns() { awk -F, 'NR == 1 { n = NF } NF != n { exit 1 } END { exit NR < 2 }' "$1"; }
for file in pairs slope_aspect profiles offsets control; do
  check "report/$file.csv has equal rows" columns "report/$file.csv"
done
cat >parse.cmake <<'END'
file(READ ${JSON} text)
string(JSON format GET "${text}" format)
string(JSON pairs LENGTH "${text}" pairs)
string(JSON level GET "${text}" limits levels 2 rmsdz_m)
if(NOT format STREQUAL "pcl_als quality" OR pairs LESS 3 OR NOT level EQUAL 0.08)
  message(FATAL_ERROR "${format} ${pairs} ${level}")
endif()
END
check "quality.json is as documented" cmake -DJSON=quality.json -P parse.cmake
# The result does not depend on the number of threads.
for threads in 1 3; do
  expect 0 "" check "${strips[@]}" -output "threads$threads.json" -threads $threads
done
check "one thread gives what three give, byte for byte" cmp threads1.json threads3.json

if [[ -x $bin/pcl_als_plot ]]; then  # built with VTK
  expect 0 "heights.png" plot quality.json -output plots
  for name in heights offset_against_distance offset_against_time offset_against_scan_angle; do
    check "$name.png is drawn" test -s plots/$name.png
  done
  # Pairs that could not be judged are on the page with the reason.
  expect 3 "1 and 3: only" check a.pcd edge.pcd -output edge.json -report edge
  check "the page says what was not judged" grep -q '<li>Not judged: strips 1 and 3 (only' edge/report.html
  check "and that there is no answer" grep -q 'class="bad">' edge/report.html
  expect 0 "1 & 2" check a.pcd b.pcd edge.pcd point.pcd -output some.json -report some
  check "a pair without numbers has its row" grep -q 'colspan="6">only' some/report.html
fi

# Before and after: every pair that slopes or overlaps enough gets better, control does.
expect 0 "converged" calibrate "${strips[@]}" -trajectory "$block/trajectory.csv" \
  -control "$block/control.csv" -output calibration.json -corrected after
expect 0 "before" check after/strip{3,1,2,4,5}.las -before "$block" -control "$block/control.csv" \
  -output both.json -report both -gis block.gpkg
# For geographic information systems: what the tables of the report hold, with outlines.
python3 - <<'PYTHON' || failed "block.gpkg"
import csv, sqlite3
package = sqlite3.connect("block.gpkg")
def rows(table): return package.execute(f"select * from {table}").fetchall()
assert len(rows("strips")) == 5, rows("strips")
for table in ("pairs", "offsets", "control"):
    with open(f"both/{table}.csv", newline="") as file:
        lines = list(csv.reader(file))
    names = [each[1] for each in package.execute(f"pragma table_info({table})")]
    assert names[2:] == lines[0], (table, names, lines[0])
    assert len(rows(table)) == len(lines) - 1, table
area = {strip: area for _, _, strip, area in rows("strips")}
assert all(1e4 < each < 1e7 for each in area.values()), area
assert package.execute("select count(*) from pairs where geom is null").fetchone()[0] == 0
PYTHON
checks=$((checks + 1))
expect 1 "-gis" check "$one" "$two" -output x.json -gis x.shp
check "both sets are in the JSON" grep -q '"before"' both.json
better=$(awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
  $at["status"] == "judged" { rms[$1, $2, $3] = $at["vertical_rms_m"] }
  $1 == "after" && $at["status"] == "judged" { pairs++; a += $at["vertical_rms_m"]; b += rms["before", $2, $3] }
  END { print (pairs >= 3 && a < 0.5 * b) }' both/pairs.csv)
check "height differences are halved at least" test "$better" = 1
check "control is met to 5 cm after" awk -F, '$1 == "after" && $10 == "" { n++; s += $7 * $7 }
  END { exit !(n > 0 && sqrt(s / n) < 0.05) }' both/control.csv
finish
