#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""Runs the tools on every real block of the test data and writes one Markdown table per block.

    tests/benchmarks/real_blocks.py BUILD [--baseline BUILD] [--data DIR] [--block NAME ...]

BUILD is a build folder with bin/pcl_als_*; --baseline names a second one, whose results stand beside.
Offsets between strips are compared with an independent estimate made here: the median over cells of
1 m of the difference of the strips' median heights, on last returns, where a cell is flat. Needs
python3-numpy; .las.xz files are unpacked into a temporary folder.
"""
import argparse
import json
import lzma
import os
import pathlib
import resource
import shutil
import struct
import subprocess
import sys
import tempfile

import numpy

FEET = 1200.0 / 3937.0  # metres per US survey foot


def read_las(path):
    """Coordinates (n x 3, in the file's unit), source ids, and whether each is a last return."""
    data = path.read_bytes()
    offset, = struct.unpack_from("<I", data, 96)
    kind, length, count = struct.unpack_from("<BHI", data, 104)
    if data[25] >= 4 and count == 0:
        count, = struct.unpack_from("<Q", data, 247)
    scale = struct.unpack_from("<6d", data, 131)
    modern = (kind & 63) >= 6
    fields = {"names": ["x", "y", "z", "returns", "source"],
              "formats": ["<i4", "<i4", "<i4", "u1", "<u2"],
              "offsets": [0, 4, 8, 14, 20 if modern else 18], "itemsize": length}
    points = numpy.frombuffer(data, numpy.dtype(fields), count, offset)
    xyz = numpy.column_stack([points[axis] * scale[i] + scale[3 + i]
                              for i, axis in enumerate("xyz")])
    bits = 4 if modern else 3
    number, of = points["returns"] & (2**bits - 1), (points["returns"] >> bits) & (2**bits - 1)
    return xyz, points["source"], number >= of


def cell_heights(xyz):
    """Median height of each flat cell of 1 m with at least three points."""
    if not len(xyz):
        return {}
    keys = numpy.floor(xyz[:, :2]).astype(numpy.int64)
    order = numpy.lexsort((xyz[:, 2], keys[:, 1], keys[:, 0]))
    keys, height = keys[order], xyz[order, 2]
    starts = numpy.flatnonzero(numpy.r_[True, (numpy.diff(keys, axis=0) != 0).any(axis=1)])
    ends = numpy.r_[starts[1:], len(keys)]
    flat = (ends - starts >= 3) & (height[ends - 1] - height[starts] < 0.2)
    return {tuple(keys[s]): height[(s + e) // 2] if (e - s) % 2 else
            0.5 * (height[(s + e) // 2] + height[(s + e) // 2 - 1])
            for s, e in zip(starts[flat], ends[flat])}


def independent_offsets(files, unit):
    """{(a, b): (median of a - b in metres, number of cells)} of all pairs of sources."""
    cells = {}
    parts = [read_las(path) for path in files]
    xyz, source, last = (numpy.concatenate([part[i] for part in parts]) for i in range(3))
    for strip in numpy.unique(source):
        cells[str(strip)] = cell_heights(unit * xyz[(source == strip) & last])
    found = {}
    for a in cells:
        for b in cells:
            common = cells[a].keys() & cells[b].keys() if a < b else ()
            if len(common) >= 100:
                found[a, b] = (float(numpy.median([cells[a][k] - cells[b][k] for k in common])),
                               len(common))
    return found


def run(command):
    """Exit status, processor seconds, last line of stderr and stdout."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([str(part) for part in command], stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, stdin=subprocess.DEVNULL, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime
    lines = done.stderr.strip().splitlines()
    return done.returncode, seconds, lines[-1] if lines else "", done.stdout


def load(path):
    return json.loads(path.read_text()) if path.exists() else None


def summary_of_check(result, _):
    if result is None:
        return []
    lines = []
    for pair in result["pairs"]:
        name = f"{pair['a']} & {pair['b']}"
        vertical = pair.get("vertical", {})
        if pair["status"] != "judged" or not vertical:
            lines.append(f"{name}: {pair['status']}")
            continue
        mean = vertical.get("mean_m", vertical.get("mean"))
        text = f"{name}: mean {mean:+.3f}"
        std = vertical.get("mean_std_m", vertical.get("mean_std"))
        if std is not None:
            text += f" ± {std:.3f}"
        rms = vertical.get("rms_m", vertical.get("rms"))
        level = pair.get("quality_level")
        text += f", RMSDz {rms:.3f} m ({level or 'no level'}), ICPatch {pair['icpatch']['status']}"
        lines.append(text)
    return lines


def summary_of_calibration(result, _):
    if result is None:
        return []
    # Files of version 1, of the tools before, have no parts.
    instrument, report = result.get("instrument", result), result.get("report", result)
    verdict = instrument.get("verdict", {}).get("status")
    lines = [verdict or ("converged" if report["converged"] else "not converged")]
    for name, p in instrument["parameters"].items():
        if p["status"] == "estimated":
            unit = {"arcsec": '"', "m": " m", "1": ""}[p["unit"]]
            digits = {"arcsec": 1, "m": 3, "1": 6}[p["unit"]]
            lines.append(f"{name} {p['bias']:+.{digits}f} ± {p['std']:.{digits}f}{unit}")
    return [", ".join(lines)]


def summary_of_alignment(result, _):
    if result is None:
        return []
    parameters = result.get("parameters", {})
    shifts = [f"{name} {parameters[name]['value']:+.3f} ± {parameters[name]['std']:.3f} m"
              for name in ("XT", "YT", "ZT") if name in parameters]
    return [", ".join([result["status"]] + shifts)]


def summary_of_info(_, text):
    return [line.strip() for line in text.splitlines() if line.strip().startswith("!")]


def no_summary(_, __):
    return []


class Block:
    def __init__(self, name, folder, scratch):
        self.name, self.folder = name, folder
        self.files = []
        for packed in sorted(folder.glob("*.las.xz")):
            target = scratch / name / packed.name[:-3]
            target.parent.mkdir(parents=True, exist_ok=True)
            with lzma.open(packed) as source, open(target, "wb") as out:
                shutil.copyfileobj(source, out)
            self.files.append(target)
        trajectory = folder / "trajectory.csv"
        self.trajectory = ["-trajectory", trajectory] if trajectory.exists() else []
        control = folder / "control.csv"
        self.control = ["-control", control] if control.exists() else []
        self.points = sum(len(read_las(path)[0]) for path in self.files)

    def jobs(self, out):
        """(tool, arguments, JSON file, summary) of every tool that the block has data for."""
        files = self.files
        yield "info", [*files], None, summary_of_info
        split = ["-split"] if self.name == "wires" else []
        if self.name != "titan":
            check = out / "check.json"
            yield "check", [*files, *self.control, *split, "-output", check], check, \
                summary_of_check
        if self.trajectory:
            result = out / "calibration.json"
            yield "calibrate", [*files, *self.trajectory, *self.control, *split, "-output", result,
                                "-report", out / "report"], result, summary_of_calibration
            if self.name == "stbarth":  # conical: no attitude can be recovered from the points
                result = out / "nominal.json"
                yield "calibrate (nominal)", [*files, *self.trajectory, "-model", "nominal",
                                              "-output", result], result, summary_of_calibration
            yield "apply", [files[0], out / "applied.las", *self.trajectory, "-calibration",
                            result], None, no_summary
            yield "intensity", [files[0], out / "intensity.las", *self.trajectory], None, no_summary
        if self.name in ("bcts", "delft_ahn3"):
            pair = {"bcts": "66:68", "delft_ahn3": "57138:57139"}[self.name]
            result = out / "icpatch.json"
            yield "icpatch", [*files, "-pair", pair, "-output", result], result, \
                summary_of_alignment
        if self.name == "helios":
            result = out / "icpatch.json"
            yield "icpatch", [files[2], files[3], "-output", result], result, summary_of_alignment
        if self.name in ("bcts", "delft_ahn3", "wires", "helios"):
            yield "profile", [*files, *split, "-auto", 3, "-output", out / "profiles"], None, \
                no_summary
        yield "view", [*files, "-output", out / "view.png"], None, no_summary


def measure(build, block, out):
    out.mkdir(parents=True, exist_ok=True)
    rows = {}
    for tool, arguments, result, summary in block.jobs(out):
        status, seconds, message, text = run([build / "bin" / f"pcl_als_{tool.split()[0]}",
                                              *arguments])
        lines = summary(load(result) if result else None, text)
        if status != 0:
            for folder in (out.parent, block.files[0].parent.parent):
                message = message.replace(f"{folder}/", "")
            lines.append(message)
        rows[tool] = (status, seconds, 1e6 * seconds / max(block.points, 1), lines)
    return rows


def table(block, before, after):
    print(f"\n## {block.name}: {block.points:,} points in {len(block.files)} files\n")
    unit = FEET if block.name == "feet" else 1.0
    for (a, b), (median, cells) in independent_offsets(block.files, unit).items():
        print(f"- independent: {a} - {b} {median:+.3f} m, median of {cells:,} flat cells of 1 m")
    print("\n| tool | version | exit | CPU s | s per 10^6 points | result |")
    print("|---|---|---|---|---|---|")
    for tool, now in after.items():
        for version, row in (("before", before.get(tool)), ("now", now)):
            if row is None:
                continue
            status, seconds, rate, lines = row
            print(f"| {tool} | {version} | {status} | {seconds:.1f} | {rate:.1f} | "
                  f"{'<br>'.join(line.replace('|', '/') for line in lines)} |")
    sys.stdout.flush()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--baseline", type=pathlib.Path)
    root = pathlib.Path(__file__).resolve().parents[2]
    parser.add_argument("--data", type=pathlib.Path,
                        default=os.environ.get("PCL_ALS_TEST_DATA", root.parent / "shared/data"))
    parser.add_argument("--block", action="append")
    options = parser.parse_args()
    data = pathlib.Path(options.data)
    folders = [data / "delft_ahn3", data / "helios", *sorted((data / "real").iterdir())]
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        for folder in folders:
            if options.block and folder.name not in options.block:
                continue
            block = Block(folder.name, folder, scratch)
            before = {}
            if options.baseline:
                before = measure(options.baseline.resolve(), block, scratch / "before" / block.name)
            table(block, before, measure(options.build.resolve(), block,
                                         scratch / "now" / block.name))


if __name__ == "__main__":
    main()
