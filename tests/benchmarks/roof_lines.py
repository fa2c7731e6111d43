#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""Compares roof lines of pcl_als_lines with the truth of simulated blocks, or between strips.

    tests/benchmarks/roof_lines.py BUILD --seeds 1:5 [--density F] [--noise range|realistic]
    tests/benchmarks/roof_lines.py BUILD --strips A.las B.las ... [--icpatch]

Simulated: one row per seed for single strips and for the lines of all strips together: lines,
false lines, ridges that were missed, and the RMS of errors over their standard deviations, of the
position across the line (left, up) and of the direction (azimuth, inclination). Strips: the same of
the differences between the lines of two strips, with --icpatch also after each strip is registered
to the first that it overlaps. Needs python3-numpy.
"""
import argparse
import csv
import itertools
import pathlib
import struct
import subprocess
import sys
import tempfile

import numpy

SIGMAS = ("sigma_plan_1", "sigma_height_1", "sigma_plan_2", "sigma_height_2")
CORRELATIONS = {"r_p1h1": (0, 1), "r_p1p2": (0, 2), "r_p1h2": (0, 3), "r_h1p2": (1, 2),
                "r_h1h2": (1, 3), "r_p2h2": (2, 3)}
# Offsets of both ends (left, up) to the position of the middle and the change along the line.
PARTS = numpy.array([[0.5, 0, 0.5, 0], [0, 0.5, 0, 0.5], [-1, 0, 1, 0], [0, -1, 0, 1]])
NAMES = ("left", "up", "azimuth", "inclination")
NEAR, PARALLEL = 0.5, numpy.cos(numpy.radians(8.0))


class Line:
    def __init__(self, row):
        self.id, self.strips = row["id"], row["strips"].split()
        self.start = numpy.array([float(row[k]) for k in ("x1", "y1", "z1")])
        self.end = numpy.array([float(row[k]) for k in ("x2", "y2", "z2")])
        sigma = numpy.array([float(row[k]) for k in SIGMAS])
        unit = numpy.eye(4)
        for name, (i, k) in CORRELATIONS.items():
            unit[i, k] = unit[k, i] = float(row[name])
        self.covariance = unit * numpy.outer(sigma, sigma)
        self.length = numpy.linalg.norm(self.end - self.start)
        self.along = (self.end - self.start) / self.length
        left = numpy.array([-self.along[1], self.along[0], 0.0])
        left /= numpy.linalg.norm(left)
        self.across = numpy.stack([left, numpy.cross(self.along, left)])

    def offsets(self, other):
        """Of the other line at the ends of this one (4), and their derivative by its offsets."""
        values, derivative = numpy.zeros(4), numpy.zeros((4, 4))
        turn = self.across @ other.across.T
        for end, at in enumerate((self.start, self.end)):
            t = self.along @ (at - other.start) / (self.along @ other.along)
            values[2 * end:2 * end + 2] = self.across @ (other.start + t * other.along - at)
            share = t / other.length
            derivative[2 * end:2 * end + 2] = numpy.hstack([(1 - share) * turn, share * turn])
        return values, derivative

    def same(self, other):
        """Whether the middle of this line is on the other, which is parallel to it."""
        if abs(self.along @ other.along) < PARALLEL:
            return False
        off = 0.5 * (self.start + self.end) - other.start
        at = other.along @ off
        return (-1.0 < at < other.length + 1.0
                and numpy.linalg.norm(off - at * other.along) < NEAR)

    def difference(self, other, exact=False):
        """Normalised parts of the other line minus this one, and the whole, of four."""
        values, derivative = self.offsets(other)
        covariance = self.covariance.copy()
        if not exact:
            covariance = covariance + derivative @ other.covariance @ derivative.T
        parts = PARTS @ covariance @ PARTS.T
        whole = values @ numpy.linalg.solve(covariance, values) / 4.0
        return PARTS @ values, PARTS @ values / numpy.sqrt(numpy.diag(parts)), whole


def read_lines(path):
    with open(path, newline="") as file:
        return [Line(row) for row in csv.DictReader(file)]


def run(build, tool, *arguments, good=(0,)):
    command = [f"{build}/pcl_als_{tool}", *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode not in good:
        sys.exit(f"{' '.join(command)}: status {done.returncode}\n{done.stderr}")
    return done.stdout


def find_lines(build, folder, name, files, *options):
    path = folder / f"{name}.csv"
    run(build, "lines", *files, "-quiet", "-output", path, *options, good=(0, 3))
    return read_lines(path)


def rms(values):
    return numpy.sqrt(numpy.mean(numpy.square(values), axis=0)) if len(values) else numpy.nan


def surface_points(path):
    """x, y of the last returns of a LAS file."""
    data = path.read_bytes()
    start, = struct.unpack_from("<I", data, 96)
    kind, length, count = struct.unpack_from("<BHI", data, 104)
    if count == 0:
        count, = struct.unpack_from("<Q", data, 247)
    scale = numpy.array(struct.unpack_from("<6d", data, 131))
    layout = numpy.dtype({"names": ["xyz", "returns"], "formats": ["(3,)<i4", "u1"],
                          "offsets": [0, 14], "itemsize": length})
    records = numpy.frombuffer(data, layout, count, start)
    number, of = ((records["returns"] & 15, records["returns"] >> 4) if (kind & 63) >= 6 else
                  (records["returns"] & 7, (records["returns"] >> 3) & 7))
    return (records["xyz"] * scale[:3] + scale[3:])[number == of, :2]


def covered(ridges, points):
    """Ridges of 4 m or more with last returns on both sides of each third."""
    cell = 20.0
    order = {}
    keys = numpy.floor(points / cell).astype(int)
    index = numpy.lexsort((keys[:, 1], keys[:, 0]))
    keys, points = keys[index], points[index]
    starts = numpy.flatnonzero(numpy.r_[True, numpy.any(numpy.diff(keys, axis=0) != 0, axis=1)])
    for first, last in zip(starts, numpy.r_[starts[1:], len(keys)]):
        order[tuple(keys[first])] = points[first:last]
    seen = []
    for ridge in ridges:
        middle = 0.5 * (ridge.start + ridge.end)[:2]
        x, y = numpy.floor(middle / cell).astype(int)
        near = [order[key] for key in itertools.product((x - 1, x, x + 1), (y - 1, y, y + 1))
                if key in order]
        if not near:
            continue
        from_start = numpy.concatenate(near) - ridge.start[:2]
        along = from_start @ ridge.along[:2] / ridge.length
        left = from_start @ ridge.across[0][:2]
        cells = {(int(3 * a), s > 0) for a, s in zip(along, left) if 0 <= a < 1 and abs(s) < 2.5}
        if len(cells) == 6:
            seen.append(ridge)
    return seen


class Score:
    """Lines against the truth, over strips and seeds."""

    def __init__(self):
        self.lines = self.false = self.ridges = self.missed = 0
        self.metres, self.parts, self.whole = [], [], []

    def add(self, lines, ridges, expected):
        self.lines += len(lines)
        found = set()
        for line in lines:
            same = [ridge for ridge in ridges if line.same(ridge)]
            self.false += not same
            for ridge in same[:1]:
                found.add(ridge.id)
                metres, parts, whole = line.difference(ridge, exact=True)
                self.metres.append(metres)
                self.parts.append(parts)
                self.whole.append(whole)
        self.ridges += len(expected)
        self.missed += sum(ridge.id not in found for ridge in expected)

    def row(self, name):
        metres, parts = rms(self.metres), rms(self.parts)
        return (f"| {name} | {self.lines} | {self.false} | {self.missed} of {self.ridges} | "
                f"{metres[0]:.3f} | {metres[1]:.3f} | " + " | ".join(f"{p:.2f}" for p in parts)
                + f" | {numpy.sqrt(numpy.mean(self.whole)):.2f} |")


def simulated(build, arguments):
    first, last = map(int, arguments.seeds.split(":"))
    print("| | lines | false | missed | left m | up m | " + " | ".join(NAMES) + " | all |")
    print("|---|---|---|---|---|---|---|---|---|---|---|")
    single, combined = Score(), Score()
    for seed in range(first, last + 1):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            run(build, "simulate", "-quiet", "-output", folder, "-preset", arguments.preset,
                "-noise", arguments.noise, "-density", arguments.density, "-images", "-seed", seed,
                "-bias", "none")
            ridges = read_lines(folder / "images/true_lines.csv")
            strips = sorted(folder.glob("strip*.las"))
            points = [surface_points(path) for path in strips]
            together = find_lines(build, folder, "lines", strips)
            seed_score = Score()
            for score in (combined, seed_score):
                score.add(together, ridges, covered(ridges, numpy.concatenate(points)))
            print(seed_score.row(f"seed {seed}"))
            if arguments.noise == "range":  # without errors of strips those of planes remain
                for path, part in zip(strips, points):
                    lines = find_lines(build, folder, path.stem, [path], "-strip_sigma", 0)
                    single.add(lines, ridges, covered(ridges, part))
    print(combined.row("all seeds"))
    if arguments.noise == "range":
        print(single.row("all seeds, strips on their own"))


def compare_strips(names, lines, text):
    print(f"\n{text}\n\n| strips | lines | left m | up m | " + " | ".join(NAMES) + " | all |")
    print("|---|---|---|---|---|---|---|---|---|")
    every = []
    for a, b in itertools.combinations(range(len(lines)), 2):
        rows = [line.difference(other) for line in lines[a] for other in lines[b]
                if line.same(other) and other.same(line)]
        every += rows
        if rows:
            print_differences(f"{names[a]}, {names[b]}", rows)
    if every:
        print_differences("all", every)


def print_differences(name, rows):
    metres, parts = rms([row[0] for row in rows]), rms([row[1] for row in rows])
    print(f"| {name} | {len(rows)} | {metres[0]:.3f} | {metres[1]:.3f} | "
          + " | ".join(f"{p:.2f}" for p in parts)
          + f" | {numpy.sqrt(numpy.mean([row[2] for row in rows])):.2f} |")


def real(build, arguments):
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        files = arguments.strips
        names = [pathlib.Path(path).stem for path in files]
        lines = [find_lines(build, folder, name, [path], "-strip_sigma", arguments.sigma)
                 for name, path in zip(names, files)]
        compare_strips(names, lines, "Strips as they are")
        if not arguments.icpatch:
            return
        registered = [pathlib.Path(files[0])]
        for name, path in list(zip(names, files))[1:]:
            output = folder / f"{name}.las"
            run(build, "icpatch", path, registered[0], "-quiet", "-output",
                folder / f"{name}.json", "-transformed", output)
            registered.append(output)
        lines = [find_lines(build, folder, f"{name}_r", [path], "-strip_sigma", arguments.sigma)
                 for name, path in zip(names, registered)]
        compare_strips(names, lines, "After ICPatch to " + names[0])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", help="folder of the tools")
    parser.add_argument("--seeds", help="FROM:TO, simulated blocks")
    parser.add_argument("--preset", default="small")
    parser.add_argument("--density", default="3", help="factor of points, 1: as the preset")
    parser.add_argument("--noise", default="realistic", choices=("range", "realistic"))
    parser.add_argument("--strips", nargs="+", help="files of one strip each")
    parser.add_argument("--icpatch", action="store_true")
    parser.add_argument("--sigma", default="0", help="metres, standard deviation of a strip")
    arguments = parser.parse_args()
    if bool(arguments.seeds) == bool(arguments.strips):
        parser.error("--seeds or --strips is needed")
    (simulated if arguments.seeds else real)(arguments.build, arguments)


if __name__ == "__main__":
    main()
