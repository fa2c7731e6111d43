#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""Compares what pcl_als_check finds in the two halves of every overlap of the real blocks.

    tests/benchmarks/real_halves.py BUILD [--data DIR] [--block NAME ...] [--stride N]

Each overlap of two strips is halved along its longer axis, across it and like a chessboard. The
differences between the halves, divided by their combined standard deviations, should have an RMS of
1. Prints one row per block. --stride uses every Nth point. Needs python3-numpy.
"""
import argparse
import itertools
import json
import lzma
import math
import os
import pathlib
import struct
import subprocess
import tempfile

import numpy

CELL = 10.0  # metres, of the map of overlaps
GAP = 5.0  # seconds, between flight lines of files without source ids
KINDS = ("mean offset", "shift in plan", "height from slopes", "ICPatch shift", "ICPatch rotation")


class Points:
    """The records of the files of a block, which have one format."""

    def __init__(self, files, stride=1):
        parts = []
        for path in files:
            data = lzma.open(path).read()
            start, = struct.unpack_from("<I", data, 96)
            kind, length, count = struct.unpack_from("<BHI", data, 104)
            if count == 0:
                count, = struct.unpack_from("<Q", data, 247)
            scale = numpy.array(struct.unpack_from("<6d", data, 131))
            modern = (kind & 63) >= 6
            layout = numpy.dtype({"names": ["xyz", "source", "time"],
                                  "formats": ["(3,)<i4", "<u2", "<f8"],
                                  "offsets": [0, 20 if modern else 18, 22 if modern else 20],
                                  "itemsize": length})
            raw = numpy.frombuffer(data, numpy.uint8, count * length, start)
            raw = raw.reshape(count, length)[::stride].copy().reshape(-1)
            records = raw.view(layout)
            xyz = records["xyz"] * scale[:3] + scale[3:]
            if not parts:
                self.header, self.scale, self.long = bytearray(data[:start]), scale, data[25] >= 4
                self.wide = modern
            records["xyz"] = numpy.rint((xyz - self.scale[3:]) / self.scale[:3])
            parts.append((raw, xyz))
        self.raw = numpy.concatenate([part[0] for part in parts]).reshape(-1, length)
        self.records = self.raw.reshape(-1).view(layout)
        self.xyz = numpy.concatenate([part[1] for part in parts])
        if not self.records["source"].any():
            times = numpy.sort(self.records["time"])
            cuts = times[1:][numpy.diff(times) > GAP]
            self.records["source"] = 1 + numpy.searchsorted(cuts, self.records["time"], "right")

    def write(self, path, chosen):
        header, records = bytearray(self.header), self.raw[chosen]
        struct.pack_into("<I", header, 107, 0 if self.wide else len(records))
        if self.long:
            struct.pack_into("<Q", header, 247, len(records))
        path.write_bytes(bytes(header) + records.tobytes())


def halves(points):
    """(name, two selections) of each overlap and way to halve it."""
    cells = numpy.floor(points.xyz[:, :2] / CELL).astype(int)
    source = points.records["source"]
    covered = {s: set(map(tuple, numpy.unique(cells[source == s], axis=0)))
               for s in numpy.unique(source)}
    for a, b in itertools.combinations(sorted(covered), 2):
        common = numpy.array(sorted(covered[a] & covered[b]))
        if len(common) < 30:
            continue
        places = CELL * (common + 0.5)
        axes = numpy.linalg.eigh(numpy.cov(places.T))[1][:, ::-1]
        at = points.xyz[:, :2] @ axes - numpy.median(places @ axes, axis=0)
        board = numpy.floor(6.0 * at / math.sqrt(len(common) * CELL**2)).astype(int)
        pair = (source == a) | (source == b)
        for name, half in (("along", at[:, 0] > 0), ("across", at[:, 1] > 0),
                           ("chessboard", board.sum(axis=1) % 2 == 1)):
            yield f"{a}-{b} {name}", (pair & half, pair & ~half)


def ratio(one, other, one_std, other_std):
    return (one - other) / math.hypot(one_std, other_std)


def moved(alignment, middle):
    """Shift at a place and rotation, with standard deviations; None: not determined."""
    value, std = ([alignment[name][what] for name in ("XT", "YT", "ZT", "omega", "phi", "kappa")]
                  for what in ("value", "std"))
    if None in value:
        return None
    turn, turn_std = numpy.radians(value[3:]), numpy.radians(std[3:])
    arm = numpy.subtract(middle, alignment["centroid_m"])
    shift_std = numpy.sqrt(numpy.square(std[:3]) + numpy.square(
        [[0, arm[2], arm[1]], [arm[2], 0, arm[0]], [arm[1], arm[0], 0]]) @ numpy.square(turn_std))
    return numpy.add(value[:3], numpy.cross(turn, arm)), shift_std, turn, turn_std


def compare(one, other):
    """Differences over standard deviations of two halves, by kind."""
    found = {kind: [] for kind in KINDS}
    if one["status"] == other["status"] == "judged":
        found["mean offset"].append(ratio(*[p["vertical"]["mean_m"] for p in (one, other)],
                                          *[p["vertical"]["mean_std_m"] for p in (one, other)]))
    h = [p["horizontal"] for p in (one, other)]
    if h[0]["determined"] and h[1]["determined"]:
        for axis in ("east_m", "north_m", "up_m"):
            kind = "height from slopes" if axis == "up_m" else "shift in plan"
            found[kind].append(ratio(*[x["shift"][axis] for x in h], *[x["std"][axis] for x in h]))
    aligned = [p.get("icpatch", {}) for p in (one, other)]
    if all(x.get("status") == "converged" for x in aligned):
        middle = numpy.mean([x["centroid_m"] for x in aligned], axis=0)
        motions = [moved(x, middle) for x in aligned]
        if None not in motions:
            (shift, std, turn, turn_std), (shift_b, std_b, turn_b, turn_std_b) = motions
            found["ICPatch shift"] += list((shift - shift_b) / numpy.hypot(std, std_b))
            found["ICPatch rotation"] += list((turn - turn_b) / numpy.hypot(turn_std, turn_std_b))
    return found


def checked(tool, points, chosen, scratch):
    """The pair of the two strips in a half; None where there is no such pair."""
    strips = {str(source) for source in numpy.unique(points.records["source"][chosen])}
    result = scratch / "half.json"
    result.unlink(missing_ok=True)
    points.write(scratch / "half.las", chosen)
    subprocess.run([tool, scratch / "half.las", "-output", result, "-quiet"],
                   stderr=subprocess.DEVNULL, check=False)
    pairs = json.loads(result.read_text())["pairs"] if result.exists() else []
    return next((pair for pair in pairs if {pair["a"], pair["b"]} == strips), None)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=pathlib.Path)
    root = pathlib.Path(__file__).resolve().parents[2]
    parser.add_argument("--data", type=pathlib.Path,
                        default=os.environ.get("PCL_ALS_TEST_DATA", root.parent / "shared/data"))
    parser.add_argument("--block", action="append")
    parser.add_argument("--stride", type=int, default=1)
    options = parser.parse_args()
    data = pathlib.Path(options.data)
    folders = [data / "delft_ahn3", data / "helios",
               *(data / "real" / name for name in ("bcts", "stbarth", "wires"))]
    print("| block | " + " | ".join(KINDS) + " |\n|" + "---|" * (len(KINDS) + 1))
    for folder in folders:
        if options.block and folder.name not in options.block:
            continue
        points = Points(sorted(folder.glob("*.las.xz")), options.stride)
        all_found = {kind: [] for kind in KINDS}
        with tempfile.TemporaryDirectory() as scratch:
            for _, pair in halves(points):
                parts = [checked(options.build / "bin/pcl_als_check", points, chosen,
                                 pathlib.Path(scratch)) for chosen in pair]
                if None in parts:
                    continue
                for kind, ratios in compare(*parts).items():
                    all_found[kind] += ratios
        cells = [f"{math.sqrt(numpy.mean(numpy.square(r))):.2f} ({len(r)})" if r else "-"
                 for r in all_found.values()]
        print(f"| {folder.name} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
