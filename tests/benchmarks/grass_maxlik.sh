#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# grass_maxlik.sh GRIDS.tif TRAINING.csv BAND,… MAP.tif: the map of pcl_als_classify against that of
# GRASS GIS (i.gensig, i.maxlik; Debian package grass-core) from the same rasters and training points.
# Equal priors, no rejection, and classes that need no regularisation. Prints how many cells differ.
set -euo pipefail
export LC_ALL=C
if [[ -z ${GISBASE:-} ]]; then
  exec grass --tmp-location XY --exec bash "$(realpath -- "$0")" "$@" 2>/dev/null
fi
grids=$1 training=$2 map=$4
IFS=, read -ra wanted <<<"$3"
names=(surface terrain height intensity slope roughness multiple_returns height_range density)
r.in.gdal -o --quiet "input=$map" output=ours
r.in.gdal -o --quiet "input=$grids" output=grid
g.region raster=ours
missing="" bands=()
for band in "${wanted[@]}"; do
  for i in "${!names[@]}"; do [[ ${names[i]} != "$band" ]] || g.rename --quiet "raster=grid.$((i + 1)),in_$band"; done
  missing+="${missing:+||}isnull(in_$band)"
  bands+=("out_$band")
done
# GRASS does not leave out cells that lack some of the bands.
for band in "${wanted[@]}"; do r.mapcalc --quiet "out_$band = if($missing, null(), in_$band)"; done
# Codes of classes are in the order in which the training names them first.
awk -F, 'NR > 1 { if (!($3 in code)) code[$3] = ++n; print $1 "," $2 "," code[$3] }' "$training" |
  r.in.xyz --quiet input=- separator=comma output=all method=max type=CELL
r.mapcalc --quiet "training = if(isnull(out_${wanted[0]}), null(), all)"
i.group --quiet group=bands subgroup=bands "input=$(IFS=,; echo "${bands[*]}")"
i.gensig --quiet trainingmap=training group=bands subgroup=bands signaturefile=signatures
i.maxlik --quiet group=bands subgroup=bands signaturefile=signatures output=theirs
r.mapcalc --quiet "differs = if(isnull(ours) != isnull(theirs), 1, if(isnull(ours), null(), ours != theirs))"
r.univar -g map=differs | awk -F= '$1 == "n" { n = $2 } $1 == "sum" { s = $2 }
  END { printf "%d cells with a class, %d differ\n", n, s }'
