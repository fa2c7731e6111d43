#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# pcl_als_view, pcl_als_profile and pcl_als_plot as users run them, with good and bad input, without
# a display.
source "$(dirname -- "$0")/tool_test.sh"
unset DISPLAY

size_of() {  # PNG: WIDTHxHEIGHT from its header
  od -An -j16 -N8 -tu1 "$1" | awk '{ print $3 * 256 + $4 "x" $7 * 256 + $8 }'
}
is_png() {  # PNG WIDTHxHEIGHT
  [[ $(head -c 8 "$1" | od -An -tx1) == " 89 50 4e 47 0d 0a 1a 0a" && $(size_of "$1") == "$2" ]]
}

strips=("$block"/strip*.las)
printf '%s\n' '# .PCD v0.7' 'VERSION 0.7' 'FIELDS x y z intensity' 'SIZE 4 4 4 4' 'TYPE F F F F' \
  'COUNT 1 1 1 1' 'WIDTH 1' 'HEIGHT 1' 'VIEWPOINT 0 0 0 1 0 0 0' 'POINTS 1' 'DATA ascii' \
  '1 2 3 4' >one.pcd
expect 0 "in the picture" view "${strips[@]}" -output top.png -size 800x600
check "top.png is a picture" is_png top.png 800x600
for color in intensity strip class return scan_angle time; do
  expect 0 "shown" view "${strips[@]}" -output "$color.png" -color $color -size 640x480 -shade edl
  check "$color.png is a picture" is_png $color.png 640x480
done
expect 0 "shown" view "${strips[@]}" -output oblique.png -azimuth 120 -elevation 30 -zoom 2 -shade hill
check "oblique.png is a picture" is_png oblique.png 1600x1000
expect 0 "shown" view "${strips[@]}" -output difference.png -color difference -reference_strip 1
check "difference.png differs from top.png" eval '! cmp -s difference.png top.png'
# The same picture again, byte for byte, and whatever the number of threads.
expect 0 "shown" view "${strips[@]}" -output again.png -size 800x600 -threads 1
check "the picture is the same every time" cmp top.png again.png
# A window stays open and shows something on the screen.
if command -v Xvfb >/dev/null && [[ -e $bin/../lib/libpcl_als_visualization.so ]]; then
  mkdir screen
  Xvfb -displayfd 3 -screen 0 1024x768x24 -fbdir screen -nolisten tcp -noreset 3>display.txt \
    2>/dev/null &
  server=$!
  for ((i = 0; i < 100; ++i)); do [[ -s display.txt ]] && break; sleep 0.1; done
  cp screen/Xvfb_screen0 empty_screen
  DISPLAY=:$(<display.txt) "$bin/pcl_als_view" "${strips[@]}" -window >window.txt 2>&1 &
  window=$!
  for ((i = 0; i < 300; ++i)); do cmp -s screen/Xvfb_screen0 empty_screen || break; sleep 0.1; done
  check "the window is drawn" eval '! cmp -s screen/Xvfb_screen0 empty_screen'
  check "the window stays open" kill "$window"
  wait "$window" 2>/dev/null
  kill "$server"
  wait "$server" 2>/dev/null
else
  echo "SKIPPED: the window of pcl_als_view: no Xvfb, or a build without VTK"
fi

# Closed standard streams, and too little memory: a picture, or status 2, a message and nothing half
# written. The tool and its libraries take some 100 MB of addresses before main() begins: with less
# there is no answer.
check "closed standard streams" eval '"$bin/pcl_als_view" "${strips[@]}" -output top_closed.png \
  -size 800x600 <&- >&- 2>&-'
check "the picture is the same with closed streams" cmp top.png top_closed.png
starts_with() { (ulimit -v "$1"; exec "$bin/pcl_als_view" -h) >/dev/null 2>&1; }
least=120000
until starts_with "$least" || ((least > 300000)); do least=$((least + 10000)); done
for kilobytes in "$least" $((least + 80000)) 400000; do
  checks=$((checks + 1))
  status=0
  (ulimit -v "$kilobytes"; exec "$bin/pcl_als_view" "${strips[@]}" -output small.png) >out.txt \
    2>err.txt || status=$?
  message=$(tail -n 1 err.txt)
  if [[ $status == 0 ]]; then
    is_png small.png 1600x1000 || failed "view with $kilobytes kB of memory: no picture"
  else
    [[ $status == 2 && $message == "pcl_als_view: "* && ! -e small.png ]] ||
      failed "view with $kilobytes kB of memory: status $status"
  fi
  rm -f small.png
done

# Few points, and points without use.
expect 0 "1 points" view one.pcd -output one.png
expect 0 "shown" view "${strips[@]}" -output top.svg -size 800x600
check "top.svg has text and points" grep -q "textLength.*elevation, m\|data:image/png" top.svg
expect 0 "shown" view "${strips[@]}" -output top.pdf -size 800x600
check "top.pdf is a document" eval '[[ $(head -c 5 top.pdf) == %PDF- ]]'
check "one point is drawn" is_png one.png 1600x1000
sed -e 's/^WIDTH 1/WIDTH 3/; s/^POINTS 1/POINTS 3/' one.pcd >level.pcd
printf '%s\n' '5 6 3 4' 'nan nan nan 1' >>level.pcd
expect 0 "2 in the picture" view level.pcd -output level.png -color elevation
check "points of one height are drawn" is_png level.png 1600x1000
sed -e 's/^WIDTH 1/WIDTH 0/; s/^POINTS 1/POINTS 0/; $d' one.pcd >empty.pcd
expect 2 "no point to draw" view empty.pcd -output empty.png
expect 2 "DISPLAY" view "${strips[0]}" -window
DISPLAY=:987654 expect 2 "DISPLAY" view "${strips[0]}" -window
expect 1 "output" view "${strips[0]}"
expect 1 "elevation" view "${strips[0]}" -output none.png -elevation 91
expect 1 "azimuth" view "${strips[0]}" -output none.png -azimuth nan
expect 1 "zoom" view "${strips[0]}" -output none.png -zoom 0
expect 1 "is also an input" view "${strips[0]}" -output "$block/../block/strip1.las"
expect 1 "size" view "${strips[0]}" -output none.png -size 10x10
expect 1 "size" view "${strips[0]}" -output none.png -size large
expect 1 "40 million pixels" view "${strips[0]}" -output none.png -size 16000x16000
expect 1 "'moonlight' is none of" view "${strips[0]}" -output none.png -color moonlight
expect 1 "reference" view "${strips[0]}" -output none.png -color difference
expect 1 "there is no strip '77'" view "${strips[0]}" -output none.png -strips 77
expect 1 "rainbow" view "${strips[0]}" -output none.png -color_map rainbow
expect 1 "LOW below HIGH" view "${strips[0]}" -output none.png -color_range 5:1
expect 1 "shade" view "${strips[0]}" -output none.png -shade moon
expect 1 "bounds" view "${strips[0]}" -output none.png -bounds 1,2,3
expect 2 "no point lies within the bounds" view "${strips[0]}" -output none.png -bounds 1,1,2,2
expect 2 "missing.las" view missing.las -output none.png
expect 2 "cannot be created: the folder does not exist" view "${strips[0]}" -output nowhere/none.png
expect 1 ".png" view "${strips[0]}" -output none.jpg
expect 1 "second strip" view "${strips[0]}" -output none.png -color difference -reference_strip 1
absent none.png

# Sections, of strips dense enough to show roofs
run simulate -output dense -preset small -scale 0.3 -density 1.5 -noise range -seed 5 -bias boresight_roll=300
strips=(dense/strip*.las)
expect 0 "gable" profile "${strips[@]}" -auto 2 -output profiles
check "profile1.png is a picture" is_png profiles/profile1.png 1600x1000
mkdir same && cp "${strips[@]}" same
expect 0 "gable" profile "${strips[@]}" -auto 1 -after same -output both -size 1000x800
check "profile1.png has both" is_png both/profile1.png 1000x800
read -r x y < <(run profile "${strips[@]}" -auto 1 -output profiles
  sed -nE 's/.* at ([0-9.]+), ([0-9.]+), .*/\1 \2/p' out.txt)
expect 0 "points" profile "${strips[@]}" -from "$(awk "BEGIN { print $x - 15 }"),$y" \
  -to "$(awk "BEGIN { print $x + 15 }"),$y" -width 3 -output section.png -size 1200x700
check "section.png is a picture" is_png section.png 1200x700
expect 0 "points" profile "${strips[@]}" -from "$(awk "BEGIN { print $x - 15 }"),$y" \
  -to "$(awk "BEGIN { print $x + 15 }"),$y" -output section.svg
check "section.svg has text and points" grep -q "textLength.*height, m\|data:image/png" section.svg
expect 1 "are needed" profile "${strips[0]}" -output none.png
expect 1 "same point" profile "${strips[0]}" -from 1,1 -to 1,1 -output none.png
expect 1 "from" profile "${strips[0]}" -from here -to 1,1 -output none.png
expect 1 "auto" profile "${strips[0]}" -auto 0 -output none
expect 2 "no point lies in the section" profile "${strips[0]}" -from 1,1 -to 9,9 -output none.png
expect 2 "no gable roof" profile "${strips[0]}" -auto 1 -output one_strip
expect 2 "missing" profile "${strips[@]}" -auto 1 -after missing_folder,x -output none
absent none.png

# Plots
strips=("$block"/strip*.las)
run calibrate "${strips[@]}" -trajectory "$block/trajectory.csv" -control "$block/control.csv" \
  -output calibration.json
expect 0 "parameters.png" plot calibration.json -output plots
for name in parameters correlation pairs convergence residuals; do
  check "$name.png is a picture" is_png plots/$name.png 1600x1000
done
expect 0 "parameters.svg" plot calibration.json -output plots -format svg
check "text of parameters.svg can be selected" grep -q ">boresight roll</text>" plots/parameters.svg
for file in plots/*.svg; do
  check "$file is below 100 kB" test "$(stat -c %s "$file")" -lt 100000
done
expect 0 "pairs.pdf" plot calibration.json -output plots -format pdf -plots pairs
check "pairs.pdf is a document" eval '[[ $(head -c 5 plots/pairs.pdf) == %PDF- ]]'
expect 1 "format" plot calibration.json -output plots -format bmp
cat >curves.json <<'END'
{"format":"other","curves":[{"name":"variance_to_mean","title":"Variance to mean","x":"slope, degrees",
  "y":"ratio","series":[{"name":"before","x":[5,15,25],"y":[3,4,5]},{"name":"after","x":[5,15,25],"y":[2,null,3]}]}],
 "confusion":{"classes":["tree","soil"],"matrix":[[5,1],[2,7]]}}
END
expect 0 "confusion.png" plot curves.json -output plots -plots variance_to_mean,confusion -size 900x600
check "variance_to_mean.png is a picture" is_png plots/variance_to_mean.png 900x600
expect 1 "there is no 'residual'*residuals" plot calibration.json -output plots -plots residual
expect 1 "output" plot calibration.json
echo '{}' >nothing.json
expect 2 "nothing that can be plotted" plot nothing.json -output plots
echo '{"curves":[{"name":"x"}]}' >broken.json
expect 2 "broken.json" plot broken.json -output plots
echo '{"confusion":{"classes":["a"],"matrix":[[1,2]]}}' >ragged.json
expect 2 "ragged.json" plot ragged.json -output plots
echo 'no json' >text.json
expect 2 "text.json" plot text.json -output plots
expect 2 "missing.json" plot missing.json -output plots
finish
