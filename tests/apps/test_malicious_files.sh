#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# Files that lie about their sizes: one line that names the file, in bounded memory and time, and no output.
source "$(dirname -- "$0")/tool_test.sh"
data=$here/../las/data
trajectory=$block/trajectory.csv

# A limit of the address space; sanitizers need terabytes of it. Each tool has 20 s, of which a slow machine under
# load needs one.
limit=1500000  # kB; the tools need 0.5 GB for their libraries and threads
ldd "$bin/pcl_als_info" | grep -q 'libasan\|libtsan' && limit=unlimited
run() {  # as in tool_test.sh, with limits
  local verb=$1
  shift
  status=0
  (ulimit -v $limit && exec timeout 20 "$bin/pcl_als_$verb" "$@" -threads 2) >out.txt 2>err.txt </dev/null || status=$?
}

patched() {  # IN OUT (POSITION TYPE VALUE)…: a copy with numbers of perl's pack at positions; negative: from the end
  perl -e 'use strict; my ($in, $out, @changes) = @ARGV; local $/; open my $f, "<:raw", $in or die; my $b = <$f>;
    while (my ($at, $type, $value) = splice @changes, 0, 3) {
      my $p = pack $type, $type =~ /[df]/ ? $value : $value =~ /^-/ ? $value : oct($value =~ /^0x/ ? $value : "0x" . sprintf("%x", $value));
      substr($b, $at < 0 ? length($b) + $at : $at, length $p) = $p }
    open my $g, ">:raw", $out or die; print $g $b' "$@"
}
refused() {  # FILE TEXT: by a tool that lists, one that converts, one that computes
  expect 2 "$1*$2" info "$1"
  expect 2 "$1*$2" convert "$1" out.las
  expect 2 "$1*$2" apply "$1" out.las -trajectory "$trajectory" -bias range_bias=0.1
  absent out.las
}
lie() {  # NAME TEXT FILE (POSITION TYPE VALUE)…
  patched "$3" "$1.laz" "${@:4}"
  refused "$1.laz" "$2"
}
uint() { perl -e 'local $/; open my $f, "<:raw", $ARGV[0]; my $b = <$f>; print unpack $ARGV[2], substr $b, $ARGV[1], 8' "$@"; }

old=$data/format1_v2.laz new=$data/format6_v3.laz
for kind in old new; do
  file=${!kind}
  points=$(uint "$file" 96 V)
  table=$(uint "$file" "$points" 'q<')
  vlr=$(uint "$file" 94 v)  # the only one, "laszip encoded"
  count=107 type=V
  [[ $kind == new ]] && count=247 type='Q<'
  # A file of two or three kilobytes that announces a billion points, or more than there are.
  lie "${kind}_billion" 'of the 1000000000 points' "$file" "$count" $type 1000000000
  [[ $kind == old ]] || lie ${kind}_huge 'points that the header announces' "$file" $count 'Q<' 0x7fffffffffffffff
  # All of them in one chunk.
  lie ${kind}_one_chunk 'cannot hold 1000000000 points' "$file" $count $type 1000000000 $((vlr + 54 + 12)) V 1000000000
  # A record of the compression that contradicts the header, or itself.
  [[ $kind == new ]] || lie old_no_chunk 'is the file complete' "$file" $((vlr + 54 + 12)) V 0
  lie ${kind}_items '"laszip encoded"' "$file" $((vlr + 54 + 32)) v 65535
  lie ${kind}_item_size '"laszip encoded"' "$file" $((vlr + 54 + 36)) v 65535
  lie ${kind}_record 'record "laszip encoded" describes points of' "$file" 105 v 65535
  lie ${kind}_vlr 'reaches past the beginning of the points' "$file" $((vlr + 20)) v 65535
  # The points are intact: only as many VLRs are read as there is room for.
  patched "$file" vlrs.laz 100 V 0xffffffff
  expect 0 'announces 4 294 967 295 VLRs, but there is room for 1' info vlrs.laz
  expect 0 '' convert "$file" intact.las
  expect 0 'announces 4 294 967 295 VLRs, but there is room for 1' convert vlrs.laz vlrs.las
  check "$kind: the points are those of the intact file" cmp vlrs.las intact.las
  lie ${kind}_points 'begin at byte 4294967295' "$file" 96 V 0xffffffff
  # A chunk table that is elsewhere, or larger than the file, is not used: the chunks follow each other.
  expect 0 '250 points' convert "$file" whole.las
  number=0
  for change in "$points q< 0x7fffffffffffffff" "$points q< 8" "$points q< -7" "$points q< -1" "$table V 9" \
    "$((table + 4)) V 0xffffffff" "$((table + 8)) Q< 0xffffffffffffffff"; do
    number=$((number + 1))
    # shellcheck disable=SC2086
    patched "$file" table.laz $change
    run convert table.laz table.las
    check "$kind, change $number of the table: the same points or a refusal" \
      eval '[[ $status == 2 && $(wc -l <err.txt) == 1 && ! -e table.las ]] || cmp whole.las table.las'
    rm -f table.las
  done
  # Chunks of variable size cannot be found without their table.
  file=$data/variable3.laz
  [[ $kind == old ]] || continue
  points=$(uint "$file" 96 V)
  lie variable_table 'chunk' "$file" "$points" 'q<' 8
  lie variable_count 'announces more chunks than fit' "$file" $(($(uint "$file" "$points" 'q<') + 4)) V 0xffffffff
done
# Zeros instead of compressed points decode to some value with next to no bytes: the announced number is checked.
for kind in old new; do
  file=${!kind}
  points=$(uint "$file" 96 V)
  { head -c "$points" "$file"; head -c 1500 /dev/zero; } >zeros.laz
  [[ $kind == new ]] || patched zeros.laz zeros.laz 107 V 1000000000
  [[ $kind == old ]] || patched zeros.laz zeros.laz 247 'Q<' 1000000000
  refused zeros.laz ''
done
# Truncated at any length.
for size in 0 3 100 227 374 400 600 1000 2000; do
  head -c $size "$new" >cut.laz
  refused cut.laz ''
done

# The chunk size of the record asks for no memory.
for kind in old new; do
  file=${!kind}
  vlr=$(uint "$file" 94 v)
  for size in 1 0x7fffffff 0x80000000 0xfffffffe; do
    lie ${kind}_chunks_$size '' "$file" $((vlr + 54 + 12)) V $size
  done
done

# Other formats of points and trajectories.
printf 'FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 1000000000\nHEIGHT 1\nPOINTS 1000000000\nDATA binary\n0123' >lie.pcd
expect 2 'lie.pcd: ' info lie.pcd
printf 'FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 9\nHEIGHT 1\nPOINTS 9\nDATA binary_compressed\n\xff\xff\xff\x7f\xff\xff\xff\x7f0' >lzf.pcd
expect 2 'lzf.pcd: ' info lzf.pcd
perl -e 'print "TSCANTRJ", pack("V4", 20010715, 1376, 1000000000, 64), "\0" x 1500' >lie.trj
expect 2 'lie.trj: its header states 1000000000 records' info -trajectory lie.trj
perl -e 'print pack("a27vvVvvvq<", "RIEGL POSITION&ORIENTATION", 1, 1, 315, 2020, 1, 2, 1e15), "\0" x 72, pack("CC", 1, 0), "\0" x 400' >lie.pof
expect 2 'lie.pof: its header states 1000000000000000 records' info -trajectory lie.pof
head -c 135 /dev/zero >lie.sbet
expect 2 'lie.sbet: its size' info -trajectory lie.sbet

# Kinds and sizes of text are looked at first. A file of 68 GB without contents takes no space on the disk.
head -c 10 "$trajectory" >sparse.csv && truncate -s 68G sparse.csv
cp sparse.csv sparse.json
mkfifo pipe.csv
mkdir folder
strip=$block/strip1.las
for input in /dev/zero sparse.csv pipe.csv folder; do
  expect 2 "$input: " apply "$strip" out.las -trajectory "$input" -bias range_bias=0.1
  expect 2 "$input: " check "$strip" -control "$input" -output out.json
  expect 2 "$input: " accuracy "$input" -output out.json
done
for input in /dev/zero sparse.json pipe.csv folder; do
  expect 2 "$input: " apply "$strip" out.las -trajectory "$trajectory" -calibration "$input"
  expect 2 "$input: " plot "$input" -output plots
done
absent out.las out.json
# A process substitution is a pipe with a program at its other end.
expect 0 points apply "$strip" piped.las -trajectory <(cat "$trajectory") -bias range_bias=0.1
expect 0 points apply "$strip" whole.las -trajectory "$trajectory" -bias range_bias=0.1
check 'a process substitution is read as a file' cmp piped.las whole.las
finish
