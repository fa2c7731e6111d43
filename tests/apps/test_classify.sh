#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# test_classify.sh BIN_DIR SCRATCH_DIR: pcl_als_classify and pcl_als_accuracy as a user runs them, with
# good and bad input.
source "$(dirname -- "${BASH_SOURCE[0]}")/tool_test.sh"
strips=("$block"/strip*.las)
training=$block/training.csv checkpoints=$block/checkpoints.csv
expect_overall() {  # JSON LOW HIGH: overall accuracy within
  checks=$((checks + 1))
  awk -v low="$2" -v high="$3" '/"overall_accuracy"/ { at = 1 }
    at && /"value"/ { gsub(/[^0-9.]/, ""); exit !($0 + 0 >= low + 0 && $0 + 0 <= high + 0) }
    END { if (!at) exit 1 }' "$1" ||
    failed "$1: overall accuracy is not in $2 to $3"
}

cmp_differs() { ! cmp -s "$1" "$2"; }

# Table 6 of Habib et al. 2011.
printf 'is,tree,built-up,grass,soil\ntree,130,40,20,18\nbuilt-up,119,386,12,16\ngrass,34,26,59,43\nsoil,20,16,10,61\n' >table6.csv
expect 0 'Overall accuracy 63.0 %' accuracy table6.csv -output table6.json
for kappa in 'tree * 0.464 ' 'built-up * 0.486 ' 'grass * 0.294 ' 'soil * 0.502 ' 'kappa 0.442 '; do
  checks=$((checks + 1))
  [[ $(<out.txt) == *$kappa* ]] || failed "Table 6: no '$kappa'"
done

# The block has intensities of two flying heights; its roads are hard to tell from soil.
expect 0 'Overall accuracy' classify "${strips[@]}" -training "$training" -checkpoints "$checkpoints" \
  -cell 2 -output map.tif -grids grids.tif -posterior posterior.tif -accuracy first.json \
  -checked first.csv -save_class_model model.json -map map.png -classified points
for file in map.tif grids.tif posterior.tif first.json first.csv model.json map.png points/strip1.las; do
  check "$file is there" test -s "$file"
done
expect_overall first.json 0.4 0.95
expect 0 'points' info points/strip1.las
check "points keep their size" test "$(stat -c %s points/strip1.las)" = "$(stat -c %s "$block/strip1.las")"

# The saved statistics give the same map; so do other tiles and one thread.
expect 0 'Overall accuracy' classify "${strips[@]}" -class_model model.json -checkpoints "$checkpoints" \
  -cell 2 -output again.tif -checked again.csv -threads 1 -classified again
check "the model gives the same map" cmp map.tif again.tif
check "and the same points" cmp points/strip1.las again/strip1.las
check "points are classified" cmp_differs points/strip1.las "$block/strip1.las"
expect 0 'tree' classify "${strips[@]}" -class_model model.json -cell 2 -output tiles.tif -tile 100 -checkpoints "$checkpoints" -checked tiles.csv
check "tiles give the same check points" cmp first.csv tiles.csv

# Cell for cell what a computation of its own makes of the same rasters, and the same posteriors.
expect 0 'no class: 0.0 % rejected' classify "${strips[@]}" -training "$training" -cell 2 -output direct.tif \
  -bands height,intensity,roughness -grids direct_grids.tif -posterior direct_p.tif
check "the map equals a direct computation" "$bin/direct_maxlik" direct_grids.tif "$training" \
  height,intensity,roughness direct.tif direct_p.tif

# Points by parts of the raster: noise keeps its class, every other byte stays.
check "points of noise" "$bin/las_damage" "$block/strip1.las" noise.las class 7
expect 0 'points' classify noise.las "${strips[@]:1}" -class_model model.json -cell 2 -output noise.tif -classified noisy
check "noise stays noise" cmp noise.las noisy/noise.las

# With texture it differs, and the two are compared on the same points.
expect 0 'Overall accuracy' classify "${strips[@]}" -training "$training" -checkpoints "$checkpoints" \
  -cell 2 -output texture.tif -checked texture.csv -bands height,intensity,roughness,height_range,slope \
  -interpolation idw -ground filter -priors soil=0.4 -reject 0.001
expect 0 'McNemar' accuracy texture.csv -compare first.csv -output comparison.json
check "the comparison is kept" grep -q '"mcnemar"' comparison.json
expect 0 'compared as independent' accuracy table6.csv -compare table6.csv -output same.json
expect 0 'Rasters' classify "${strips[@]}" -cell 5 -grids only.tif
check "only rasters" test -s only.tif

# Without ground points: heights cannot be had, other bands can.
expect 2 'no ground points' classify "${strips[@]}" -training "$training" -cell 5 -output bad.tif -ground_classes 40
expect 0 'note: no ground points' classify "${strips[@]}" -training "$training" -cell 5 -output low.tif \
  -ground_classes 40 -bands intensity,roughness

# Training areas: squares of 6 m about the training points.
awk -F, 'BEGIN { printf "{\"type\":\"FeatureCollection\",\"features\":[" }
  NR > 1 { w = $1 - 3; e = $1 + 3; s = $2 - 3; n = $2 + 3
    printf "%s{\"type\":\"Feature\",\"properties\":{\"class\":\"%s\"},\"geometry\":{\"type\":\"Polygon\",\"coordinates\":[[[%.3f,%.3f],[%.3f,%.3f],[%.3f,%.3f],[%.3f,%.3f],[%.3f,%.3f]]]}}", (NR > 2 ? "," : ""), $3, w, s, e, s, e, n, w, n, w, s }
  END { print "]}" }' "$training" >areas.geojson
expect 0 'Overall accuracy' classify "${strips[@]}" -training areas.geojson -checkpoints "$checkpoints" \
  -cell 2 -output areas.tif -accuracy areas.json -save_class_model areas_model.json
expect_overall areas.json 0.4 0.95
check "areas give more samples than points" awk '/"samples"/ { gsub(/[^0-9]/, ""); n += $0 } END { exit !(n > 1000) }' areas_model.json

# Training that is thin, missing, elsewhere.
awk -F, 'NR == 1 || $3 != "grass" || !seen++' "$training" >one_grass.csv
run classify "${strips[@]}" -training one_grass.csv -checkpoints "$checkpoints" -cell 2 -output one.tif
checks=$((checks + 1))
[[ $status == 3 && $(<out.txt) == *"class grass: 1 sample determines no covariance"* && -s one.tif ]] ||
  failed "one training point: status 3, a note and the map"
expect 3 'no reliable answer: too few training samples for class grass' classify "${strips[@]}" \
  -training one_grass.csv -cell 2 -output one.tif -quiet
awk -F, '$3 != "grass"' "$training" >no_grass.csv
expect 0 'class grass: 150 check sites but no training; counted as wrong' classify "${strips[@]}" \
  -training no_grass.csv -checkpoints "$checkpoints" -cell 2 -output no.tif -map no.png -beside map.tif
awk -F, '$3 != "grass"' "$checkpoints" >no_grass_checks.csv
expect 0 'note: no check point is grass' classify "${strips[@]}" -class_model model.json -checkpoints no_grass_checks.csv \
  -cell 2 -output no.tif
expect 0 '(singular)' classify "${strips[@]}" -training "$training" -cell 2 -output singular.tif \
  -bands height,multiple_returns -save_class_model singular.json
check "the model keeps the remark" grep -q 'regularised with .*(singular)' singular.json

# Cells without points: the block's corners, 200 m beyond its edges.
wide=(-bounds 699000,5659000,701000,5661000 -cell 2)
printf 'x,y,class\n699001,5659001,tree\n700999,5660999,soil\n' >corners.csv
(cat "$checkpoints"; sed 1d corners.csv) >some_empty.csv
expect 0 ' check points on cells without a class, counted as wrong' classify "${strips[@]}" -class_model model.json \
  -checkpoints some_empty.csv "${wide[@]}" -output empty.tif -checked empty.csv
check "empty cells have no class in the list" grep -q '^699001.000,5659001.000,tree,$' empty.csv
expect 0 'Overall accuracy 0.0 %' classify "${strips[@]}" -class_model model.json -checkpoints corners.csv "${wide[@]}" \
  -output empty.tif -accuracy empty.json
(cat "$training"; sed 1d corners.csv) >training_empty.csv
expect 0 'training sites on cells without values' classify "${strips[@]}" -training training_empty.csv "${wide[@]}" \
  -output empty.tif
expect 2 'corners.csv: *at least two classes*2 training sites on cells without values' classify "${strips[@]}" \
  -training corners.csv "${wide[@]}" -output bad.tif
printf 'x,y,class\n1,2,tree\n3,4,soil\n' >elsewhere.csv
expect 2 'elsewhere.csv: *at least two classes*2 training sites outside' classify "${strips[@]}" -training elsewhere.csv -cell 2 -output bad.tif
expect 2 'elsewhere.csv: no check site lies in the rasters' classify "${strips[@]}" -training "$training" -checkpoints elsewhere.csv -cell 2 -output outside.tif
(cat "$checkpoints"; sed 1d elsewhere.csv) >some_outside.csv
expect 0 '2 check sites outside of the rasters' classify "${strips[@]}" -training "$training" -checkpoints some_outside.csv -cell 2 -output some.tif

# Wrong usage and unusable files.
expect 1 'options -output and -grids is needed' classify "${strips[@]}" -training "$training"
expect 1 '-training and -class_model' classify "${strips[@]}" -output bad.tif
expect 1 "no band 'colour'" classify "${strips[@]}" -training "$training" -output bad.tif -bands colour
expect 2 'no point has the extra bytes echo_width' classify "${strips[@]}" -training "$training" \
  -output bad.tif -cell 5 -bands height,echo_width
expect 1 'option -cell' classify "${strips[@]}" -training "$training" -output bad.tif -cell 0
expect 1 'option -bounds' classify "${strips[@]}" -training "$training" -output bad.tif -bounds 1,2,3
expect 1 'no such class' classify "${strips[@]}" -training "$training" -output bad.tif -priors water=0.5 -cell 5
expect 1 'none of tin, idw' classify "${strips[@]}" -training "$training" -output bad.tif -interpolation spline
expect 1 'is also another output' classify "${strips[@]}" -training "$training" -output bad.tif -grids bad.tif
expect 1 '-classified needs -output' classify "${strips[@]}" -grids bad.tif -classified bad
expect 1 'strip1.las is also an input' classify "${strips[@]}" -training "$training" -output bad.tif -classified "$block"
expect 1 'training.csv is also an input' classify "${strips[@]}" -training "$training" -output bad.tif -checkpoints "$checkpoints" -accuracy "$training"
mkdir -p twin && cp "$block/strip1.las" twin/
expect 1 'strip1.las is also another output' classify "$block/strip1.las" twin/strip1.las -training "$training" -output bad.tif -classified bad_points
expect 2 'no names of classes' classify "${strips[@]}" -training "$training" -output bad.tif -map bad.png -beside grids.tif
# A header that tells of 300000 x 300000 cells (tags 256 and 257, the first of the directory).
cp map.tif lie.tif
directory=$(od -An -tu4 -j4 -N4 map.tif)
for tag in 0 1; do
  printf '\x04\x00\x01\x00\x00\x00\xe0\x93\x04\x00' |
    dd of=lie.tif bs=1 seek=$((directory + 2 + 12 * tag + 2)) conv=notrunc status=none
done
expect 2 'lie.tif: its header declares 300000 x 300000 cells' classify "${strips[@]}" -training "$training" -output bad.tif -map bad.png -beside lie.tif
expect 2 'none.tif: *there is no such file' classify "${strips[@]}" -training "$training" -output bad.tif -map bad.png -beside none.tif
printf 'x,y,class\n1,2,unclassified\n' >reserved.csv
expect 2 "named 'unclassified'" classify "${strips[@]}" -training reserved.csv -output bad.tif
sed 's/"samples": [0-9]*/"samples": -3/' model.json >negative.json
expect 2 'its samples are no count' classify "${strips[@]}" -class_model negative.json -output bad.tif
sed 's/"prior": [0-9.]*/"prior": 0.9/' model.json >priors.json
expect 2 'priors.json: the priors of all classes together must be 1' classify "${strips[@]}" -class_model priors.json -output bad.tif
expect 2 'no such file' classify "${strips[@]}" -training none.csv -output bad.tif
expect 2 'no file of class statistics' classify "${strips[@]}" -class_model first.json -output bad.tif
expect 2 'folder does not exist' classify "${strips[@]}" -training "$training" -output none/bad.tif -cell 5
expect 2 'folder does not exist' classify "${strips[@]}" -training "$training" -output bad.tif -map none/bad.png
expect 1 'option -reject' classify "${strips[@]}" -training "$training" -output bad.tif -reject 0.9
expect 2 'no point lies in the rasters' classify "${strips[@]}" -training "$training" -output bad.tif -bounds 0,0,100,100
expect 1 "option -crs: 'EPSG:1' is not known to PROJ" classify "${strips[@]}" -training "$training" -output bad.tif -crs EPSG:1 -cell 5
expect 1 'option -output is needed' accuracy table6.csv
expect 1 'table6.csv is also an input' accuracy table6.csv -output table6.csv
expect 2 'no such file' accuracy none.csv -output bad.json
printf 'is,a,b\na,1,x\nb,3,4\n' >bad.csv
expect 2 "line 2, column 'b': 'x' is not a count" accuracy bad.csv -output bad.json
expect 2 'not of the same kind' accuracy table6.csv -compare first.csv -output bad.json
head -n 20 first.csv >few.csv
expect 2 'the same points' accuracy first.csv -compare few.csv -output bad.json
absent bad.tif bad.json bad.png bad_points/strip
finish
