#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# pcl_als_convert: formats, parts of files, a file for each strip, wrong usage.
source "$(dirname -- "$0")/tool_test.sh"
strip=$block/strip1.las

# There and back is the same to the byte, with any number of threads.
expect 0 "points" convert "$strip" packed.laz
expect 0 "points" convert "$strip" one.laz -threads 1
check "one thread as many" cmp packed.laz one.laz
expect 0 "points" convert packed.laz back.las
check "LAS to LAZ to LAS" cmp "$strip" back.las
check "LAZ is smaller" test "$(stat -c %s packed.laz)" -lt "$(stat -c %s "$strip")"

# The tools read what comes out.
expect 0 "points" convert "$strip" strip.pcd
expect 0 "LAZ 1." info packed.laz
expect 0 "PCD binary" info strip.pcd
expect 0 "" convert strip.pcd strip.las
expect 0 "point format 6" info strip.las

# Parts.
read -r west east south north < <("$bin/pcl_als_info" "$strip" |
  awk '/^  extent/ { gsub(",", ""); print $3, $5, $7, $9; exit }')
middle=$(awk -v a="$west" -v b="$east" 'BEGIN { printf "%.3f", (a + b) / 2 }')
expect 0 "points" convert "$strip" west.laz -bounds "$west,$south,$middle,$north"
expect 0 "" info west.laz -output west.json
check "the part is smaller" test "$(stat -c %s west.laz)" -lt "$(stat -c %s packed.laz)"
expect 2 "no point lies within the bounds; *covers by its header x " convert "$strip" none.laz -bounds 0,0,1,1
absent none.laz
expect 1 "-bounds" convert "$strip" none.laz -bounds 1,2,3
expect 1 "smaller values first" convert "$strip" none.laz -bounds 3,3,1,1
expect 0 "strip 1: * excluded: " convert "$block"/strip1.las "$block"/strip2.las chosen -without 1 -format laz
absent chosen/strip1.laz none.laz
check "the other strip" test -s chosen/strip2.laz

# A file for each strip, also of one file with all of them.
expect 0 "lines/1.laz" convert "$block"/strip*.las lines -split -format laz
expect 1 "needs a folder" convert "$block"/strip*.las lines.las -split
# A dot is a part of many names of folders.
expect 0 "lines.v2/1.laz" convert "$block"/strip*.las lines.v2 -split -format laz
check "the same files" cmp lines.v2/1.laz lines/1.laz
expect 0 "lines.v2/1.laz" convert "$block"/strip*.las lines.v2 -split -format laz  # a folder by now
expect 0 "" convert "$block"/strip1.las "$block"/strip2.las both.2026 -format pcd
check "two files in a folder" test -s both.2026/strip2.pcd
echo text >notes.v3
for file in notes.v3 lines.laz lines.PCD lines.ply; do
  expect 1 "needs a folder" convert "$block"/strip1.las $file -split
done
check "the file is as it was" test "$(<notes.v3)" = text
expect 1 "does not end in" convert "$strip" one.v2
absent one.v2 lines.laz lines.PCD lines.ply
expect 1 "several inputs need a folder" convert "$block"/strip1.las "$block"/strip2.las both.las

# Lines that share a point source id get numbers of their own: in a file each, or in their tiles.
mkdir tiles
for k in 1 2 3; do
  perl -e 'binmode STDIN; binmode STDOUT; local $/; my $las = <STDIN>;
    my ($at, $length) = (unpack("V", substr($las, 96, 4)), unpack("v", substr($las, 105, 2)));
    for (; $at + $length <= length $las; $at += $length) { substr($las, $at + 20, 2) = pack("v", 9) }
    print $las' <"$block/strip$k.las" >"tiles/t$k.las"
done
expect 0 "point source ids of lines: 9.1 = 1, 9.2 = 2, 9.3 = 3" convert tiles/t*.las numbered -number_lines
expect 0 "point source ids of lines: 9.1 = 1" convert tiles/t*.las parts -split
for k in 1 2 3; do
  check "tile $k has the number of its line" cmp "numbered/t$k.las" "$block/strip$k.las"
  check "and the file of the line" cmp "parts/9.$k.las" "$block/strip$k.las"
done
expect 0 "points" convert tiles/t*.las kept -split -keep_ids
check "the ids are as they were" cmp kept/9.2.las tiles/t2.las
expect 1 "-keep_ids needs -split" convert tiles/t*.las kept -keep_ids
expect 1 "-number_lines and -split exclude each other" convert tiles/t*.las x -split -number_lines

# PLY and text: the same points, in every column.
points_of() { "$bin/pcl_als_convert" "$1" "$2" -quiet && grep -v '^#' "$2" >"$2.lines"; }
expect 0 "points" convert "$strip" strip.ply
expect 0 "points" convert "$strip" text.ply -ascii
expect 0 "PLY binary_little_endian" info strip.ply
expect 0 "PLY ascii" info text.ply
check "points of LAS as text" points_of "$strip" las.xyz
check "as many as there are" test "$(($(wc -l <las.xyz.lines) - 1))" -gt 1000
for kind in strip.ply text.ply las.xyz; do
  expect 0 "points" convert $kind "$kind.las"
  check "points of $kind as text" points_of "$kind.las" "$kind.xyz"
  check "LAS to $kind to LAS" cmp "$kind.xyz.lines" las.xyz.lines
done
expect 0 "points" convert strip.ply west.ply -bounds "$west,$south,$middle,$north"
expect 0 "points" convert west.laz west_of_laz.xyz
expect 0 "points" convert west.ply west_of_ply.xyz
# Coordinates of a LAS file have the decimals of its scale, those of a PLY file, which has none, six.
millimetres() { awk '!/^[#x]/ { $1 = sprintf("%.3f", $1); $2 = sprintf("%.3f", $2); $3 = sprintf("%.3f", $3); print }' "$1"; }
check "a part of a PLY" cmp <(millimetres west_of_laz.xyz) <(millimetres west_of_ply.xyz)
expect 0 "lines3/1.ply" convert "$block"/strip*.las lines3 -split -format ply

# Text of others: names of columns, no times, damage.
printf 'x y z\n1 2 3\n4 5 6\n' >timeless.xyz
printf '%s\n' '30 1000.5 2000.25 7' '31 1001.5 2001.25 8' >other.xyz
expect 2 "other.xyz: line 1: there are 4 columns and no header line names them" convert other.xyz other.las
expect 0 "points" convert other.xyz other.las -columns z,x,y,intensity
expect 0 "every GPS time is zero" info other.las
expect 0 "the points have no GPS time" info timeless.xyz
expect 1 "columns of other.xyz: none of them is z" convert other.xyz x.las -columns x,y,skip,skip
printf 'x y z\n1 2 3\n4 five 6\n' >damaged.xyz
expect 2 "damaged.xyz: line 3: column y: 'five' is no number" convert damaged.xyz x.las
head -c 5000 strip.ply >cut.ply
expect 2 "cut.ply: the header declares" convert cut.ply x.las
expect 2 "GPS time" calibrate timeless.xyz "$strip" -trajectory "$block/trajectory.csv" -output x.json
expect 2 "of .ply files no corrected copies are written" apply strip.ply x.las -trajectory "$block/trajectory.csv" -bias range_bias=1
expect 2 "of .ply files no corrected copies are written" intensity strip.ply -corrected copies -trajectory "$block/trajectory.csv"
absent x.las x.json copies

# Wrong usage; inputs stay as they are.
expect 1 "usage: pcl_als_convert" convert "$strip"
expect 1 "none of las, laz, pcd" convert "$strip" folder -format txt
expect 1 "does not end in .las, .laz, .pcd" convert "$strip" points.txt
expect 1 "COPC" convert "$strip" out.copc.laz
cp "$strip" own.las
expect 1 "is also an input" convert own.las ./own.las
expect 1 "is also an input" convert own.las "$PWD"
check "the input is as it was" cmp "$strip" own.las
expect 2 "there is no such file" convert missing.las out.las
head -c 100000 packed.laz >cut.laz
expect 2 "cut.laz: *; pcl_als_convert -keep_readable saves what is intact" convert cut.laz out.las
expect 2 "-keep_readable" apply cut.laz out.las -trajectory "$block/trajectory.csv" -bias range_bias=1

# What is intact of a truncated or damaged file.
expect 2 "cut.laz: none of its points can be read: " convert cut.laz out.las -keep_readable
expect 0 "points" convert "$strip" whole.las -keep_readable
check "an undamaged file is the same" cmp whole.las "$strip"
head -c 200000 "$strip" >cut.las
expect 2 "cut.las: the header declares*; pcl_als_convert -keep_readable saves" convert cut.las out.las
expect 0 "cut.las: 5 8?? of 17 206 points" convert cut.las kept.laz -keep_readable
expect 0 "5 8" info kept.laz
expect 0 "cut.las: 5 8?? of 17 206 points" info cut.las -keep_readable
expect 2 "cut.las: the header declares" info cut.las
expect 0 "cut.las: 5 8?? of 17 206 points" view cut.las -keep_readable -output cut.png
run check cut.las "$block/strip2.las" -keep_readable -output kept.json
check "the check warns of it" grep -q 'cut.las: 5 8.. of 17 206 points' kept.json
absent out.las points.txt out.copc.laz folder
finish
