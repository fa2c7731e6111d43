#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# figure.sh OUT_DIR PROFILE PNG: the picture misfit.png from the demo's OUT_DIR. PROFILE is the program
# of share/examples/pipeline; needs gnuplot. Height of strip 2 above strip 1 along a line across both
# swaths: means over cells of 4 m x 8 m on open ground (cells with a range of heights over 0.6 m,
# roofs, trees and steep slopes, are left out).
set -euo pipefail
export LC_ALL=C
cd -- "$1"
for when in block corrected; do
  "$2" 699600 5660028 700400 5660028 4 $when/strip1.las $when/strip2.las |
    awk 'NF == 2 { k = file + 0 " " int($1 / 4); n[k]++; s[k] += $2
                   if (!(k in lo) || $2 < lo[k]) lo[k] = $2
                   if (!(k in hi) || $2 > hi[k]) hi[k] = $2 }
         NF == 0 && ++blank == 2 { file++; blank = 0 }
         END { for (i = 0; i < 200; ++i) { a = "0 " i; b = "1 " i
                 if (n[a] > 9 && n[b] > 9 && hi[a] - lo[a] < 0.6 && hi[b] - lo[b] < 0.6)
                   print 4 * i + 2 - 400, s[b] / n[b] - s[a] / n[a] } }' >"difference_$when.txt"
done
gnuplot <<END
set terminal pngcairo size 900,340 font "sans,11"
set output "$3"
set xlabel "across the flight direction, m"
set ylabel "strip 2 - strip 1, m"
set grid lc rgb "#dddddd"
set key top center horizontal
plot [-400:400] "difference_block.txt" with points pt 7 ps 0.7 lc rgb "#d62728" title "as delivered", \
  "difference_corrected.txt" with points pt 7 ps 0.7 lc rgb "#1f77b4" title "calibrated and corrected"
END
