#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""Ordinary mistakes of a working day, and what the tools say of each.

    tests/benchmarks/practice.py BUILD [--only WORD] [--seed N]
    tests/benchmarks/practice.py BUILD --figures [--seed N]

Each situation is made from a simulated block by changing its files as the mistake does, and given
to a tool with the command that a user would type. Prints a Markdown table with the truth beside
the sentence of the tool. A situation holds if the tool says what is expected, and never "usable"
where it must not; the status of this script is 1 if one does not. Deterministic for a seed.
--figures compares what a calibration states of the corrected strips with what another calibration
finds in the files that were corrected by it, for all presets of the simulator.
"""
import argparse
import json
import math
import pathlib
import re
import shutil
import subprocess
import tempfile

import numpy

FIELDS = {"names": ["x", "y", "z", "intensity", "flags", "user_data", "angle", "id", "time"],
          "formats": ["<i4", "<i4", "<i4", "<u2", "u1", "u1", "<i2", "<u2", "<f8"],
          "offsets": [0, 4, 8, 12, 15, 17, 18, 20, 22]}
SCAN_DIRECTION = 0x40
UNIX_TIME = 1_756_080_000  # 2025-08-25


def edit(path, change, output=None):
    """Changes the point records of a LAS file of format 6; change gets the records and their
    scales."""
    data = bytearray(path.read_bytes())
    start, length = int.from_bytes(data[96:100], "little"), int.from_bytes(data[105:107], "little")
    count = int.from_bytes(data[247:255], "little")
    records = numpy.frombuffer(data, numpy.dtype({**FIELDS, "itemsize": length}), count, start)
    change(records, numpy.frombuffer(data, "<f8", 3, 131))
    (output or path).write_bytes(data)


def join(paths, output):
    """The points of several LAS files of one format in one file, in order; the parts are deleted."""
    data = bytearray(paths[0].read_bytes())
    count = int.from_bytes(data[247:255], "little")
    for path in paths[1:]:
        other = path.read_bytes()
        count += int.from_bytes(other[247:255], "little")
        data += other[int.from_bytes(other[96:100], "little"):]
    data[247:255] = count.to_bytes(8, "little")
    for path in paths:
        path.unlink()
    output.write_bytes(data)


def edit_csv(path, change, output=None):
    """Changes the rows of a CSV file: change(row, column by name) returns a row, or None."""
    lines = path.read_text().splitlines()
    head = next(i for i, line in enumerate(lines) if not line.startswith("#"))
    columns = {name: i for i, name in enumerate(lines[head].split(","))}
    rows = [change(line.split(","), columns) for line in lines[head + 1:]]
    kept = [",".join(row) for row in rows if row is not None]
    (output or path).write_text("\n".join(lines[:head + 1] + kept) + "\n")


def moved(column, metres):
    """A change of edit_csv() that adds to a column."""
    def change(row, columns):
        row[columns[column]] = repr(float(row[columns[column]]) + metres)
        return row
    return change


def raised(metres):
    def change(records, scale):
        records["z"] += numpy.int32(round(metres / scale[2]))
    return change


class Block:
    """A simulated block in a folder of its own, and the tools."""

    def __init__(self, build, folder, seed):
        self.build, self.folder, self.seed = build, folder, seed

    def simulate(self, *options, preset="small", scale=0.5, density=0.3):
        self.run("simulate", "-preset", preset, "-scale", scale, "-density", density, "-noise",
                 "realistic", "-seed", self.seed, "-output", self.folder, *options)
        return self

    def run(self, verb, *arguments):
        command = [self.build / f"bin/pcl_als_{verb}", *arguments]
        done = subprocess.run([str(part) for part in command], capture_output=True, text=True,
                              check=False, cwd=self.folder)
        return done.returncode, done.stdout + done.stderr

    def strips(self, *numbers):
        if numbers:
            return [self.folder / f"strip{k}.las" for k in numbers]
        return sorted(self.folder.glob("strip*.las"))

    @property
    def trajectory(self):
        return self.folder / "trajectory.csv"

    @property
    def control(self):
        return self.folder / "control.csv"

    def calibrate(self, *options, files=None, trajectory=None, control=True):
        arguments = [*(files or self.strips()), "-trajectory", trajectory or self.trajectory]
        if control:
            arguments += ["-control", self.control]
        return self.run("calibrate", *arguments, "-output", "c.json", *options)

    def check(self, *options, files=None):
        return self.run("check", *(files or self.strips()), "-output", "q.json", *options)

    def result(self):
        return json.loads((self.folder / "c.json").read_text())

    def errors(self):
        """The largest error of a determined parameter over its standard deviation, as a sentence."""
        truth = json.loads((self.folder / "truth.json").read_text())["bias"]
        truth = {name.removesuffix("_arcsec").removesuffix("_m"): value
                 for name, value in truth.items()}
        worst, name = 0.0, "none"
        for parameter, estimate in self.result()["instrument"]["parameters"].items():
            if estimate["status"] != "estimated" or not estimate.get("determined", True):
                continue
            error = abs(estimate["bias"] - truth[parameter]) / estimate["std"]
            if error > worst:
                worst, name = error, parameter
        return f"largest error: {worst:.1f} standard deviations ({name})\n"


SITUATIONS = []


def situation(title, truth, expected, forbidden=None):
    """Registers a function of a Block that returns (status, text) of a tool. expected, forbidden:
    regular expressions for the text."""
    def register(function):
        SITUATIONS.append((title, truth, expected, forbidden, function))
        return function
    return register


@situation("antenna height of the base 1.5 m wrong, `check`", "control 1.5 m above the strips",
           r"the strips lie 1\.5\d ± 0\.\d+ m below all \d+ control points", r"\(class \d")
def check_antenna(block):
    block.simulate("-bias", "none")
    edit_csv(block.control, moved("z", 1.5))
    return block.check("-control", block.control)


@situation("the same, `calibrate`", "control 1.5 m above the strips",
           r"height_offset.*-1\.[45]|1\.[45]\d.* m below", r"range_bias .*1\.[45]")
def calibrate_antenna(block):
    block.simulate("-bias", "none")
    edit_csv(block.control, moved("z", 1.5))
    return block.calibrate()


@situation("geoid 0.3 m wrong, one flying height, `calibrate`", "range bias 0, block 0.3 m low",
           r"height.offset")
def calibrate_geoid(block):
    block.simulate("-bias", "none")
    edit_csv(block.control, moved("z", 0.3))
    return block.calibrate()


@situation("points and trajectory 0.3 m low, `calibrate`", "height_offset -0.3 m",
           r"height.offset", r"scan_angle_scale .*probability 1\.000")
def calibrate_low_block(block):
    block.simulate("-bias", "none", "-ins", "tactical")
    for strip in block.strips():
        edit(strip, raised(-0.3))
    edit_csv(block.trajectory, moved("z", -0.3))
    return block.calibrate()


@situation("vertical control moved in plan, `check`", "0.6 m east, 0.4 m south",
           r"movement of the strips (by|onto).*0\.[56]\d.*0\.[345]\d")
def check_plan(block):
    block.simulate("-bias", "none", scale=1.0)

    def move(row, columns):
        return moved("y", -0.4)(moved("x", 0.6)(row, columns), columns)
    edit_csv(block.control, move)
    return block.check("-control", block.control)


@situation("a second day 0.25 m high, `-systems -own offset`", "strips 4-5 0.25 m high, removed",
           r"10 of 10 pairs keep QL2")
def own_offset(block):
    block.simulate("-bias", "none", "-sessions", 2, "-error", "session2:offset_z=0.25")
    status, text = block.calibrate("-systems", "A=1-3", "B=4-5", "-own", "offset", "-corrected",
                                   "out")
    if status != 0:
        return status, text
    return block.run("check", *sorted((block.folder / "out").glob("*.las")), "-output", "q.json")


@situation("two flights with different base stations, `check`", "2.3 m apart",
           r"too far apart in height.*2\.3\d m")
def check_two_flights(block):
    block.simulate("-bias", "none")
    for strip in block.strips()[3:]:
        edit(strip, raised(2.3))
    return block.check()


@situation("the same, `calibrate`", "2.3 m apart", r"too far apart in height", r"verdict: usable")
def calibrate_two_flights(block):
    block.simulate("-bias", "none")
    for strip in block.strips()[3:]:
        edit(strip, raised(2.3))
    return block.calibrate()


def same_id(records, _):
    records["id"] = 7


@situation("all lines under one id, `check`", "5 lines", r"strip 7 holds \d flight lines")
def check_one_id(block):
    block.simulate("-bias", "none")
    for strip in block.strips():
        edit(strip, same_id)
    join(block.strips(), block.folder / "strip.las")
    return block.check()


@situation("all lines under one id, `calibrate`", "roll -90\"",
           r"holds 5 flight lines[\s\S]*largest error: [012]\.")
def calibrate_one_id(block):
    block.simulate()
    for strip in block.strips():
        edit(strip, same_id)
    join(block.strips(), block.folder / "strip.las")
    status, text = block.calibrate()
    return status, text + block.errors()


@situation("two ids in one pass, `check`", "strip 1 is a half of strip 9's pass",
           r"measured in one pass.*1 and 9|9 and 1")
def check_one_pass(block):
    block.simulate("-bias", "none")

    def alternate(records, _):
        records["id"][::2] = 9
    edit(block.strips()[0], alternate)
    return block.check()


@situation("two scanners 60\" apart, told apart by user data only, `calibrate`",
           "user_data 1 differs by 60\" in roll", r"user_data.*roll.*differs by -?[56]\d",
           r"verdict: usable")
def calibrate_user_data(block):
    block.simulate("-scanner", "dual", "-error", "channel1:boresight_roll=60")

    def hide(records, _):
        records["user_data"] = (records["flags"] >> 4) & 3
        records["flags"] &= 0xCF
    for strip in block.strips():
        edit(strip, hide)
    return block.calibrate()


@situation("mirror torsion without recorded scan directions, `calibrate`",
           "sweeps to the left differ by -50\" in roll",
           r"scanned_to_the_left.*differs by -(49|5[01])", r"verdict: usable")
def calibrate_torsion(block):
    block.simulate("-error", "mirror_torsion=25")

    def hide(records, _):
        records["flags"] &= 0xFF ^ SCAN_DIRECTION
    for strip in block.strips():
        edit(strip, hide)
    return block.calibrate()


@situation("encoder with an error of 30\" sin(36 b), `calibrate`",
           "RMS 21\", of which the scale and a cubic function take a part",
           r"verdict: .*scan_angle_curve: the scan angle has an error of (1[3-9]|2\d)",
           r"check the attitude of the trajectory")
def encoder(block):
    block.simulate("-error", "encoder_sine=30", scale=0.8, density=0.5)
    return block.calibrate()


@situation("times in Unix seconds, `info`", "2025-08-25", r"Unix")
def info_unix(block):
    block.simulate("-time", "adjusted")

    def unix(records, _):
        records["time"] = UNIX_TIME + records["time"] % 86400
    edit(block.strips()[0], unix)
    return block.run("info", block.strips()[0])


@situation("times in Unix nanoseconds, `info`", "the same", r"Unix.*nano|nano.*Unix", r"no number")
def info_nanoseconds(block):
    block.simulate("-time", "adjusted")

    def unix(records, _):
        records["time"] = (UNIX_TIME + records["time"] % 86400) * 1e9
    edit(block.strips()[0], unix)
    return block.run("info", block.strips()[0])


@situation("one id on two days, 44 days apart, `calibrate -trajectory reconstruct`",
           "two lines; work follows observed times", r"strip 7 holds \d flight lines|verdict")
def gap(block):
    block.simulate("-time", "adjusted", scale=0.3)

    def later(records, _):
        records["time"] += 44 * 86400.0
    edit(block.strips()[1], later)
    for strip in block.strips():
        edit(strip, same_id)
    return block.calibrate(trajectory="reconstruct")


@situation("trajectory 1 s late, `apply`", "1 s", r"behind|late|ahead|beside|refuse")
def late(block):
    block.simulate("-bias", "none")
    edit_csv(block.trajectory, moved("time", 1.0))
    return block.run("apply", block.strips()[0], "o.las", "-trajectory", block.trajectory,
                     "-bias", "boresight_roll=1")


@situation("trajectory 80 m above the true one, `apply`", "80 m at 1150 m",
           r"above.*(6|7|8|9)\d\.?\d* m|(6|7|8|9)\d\.?\d* m .*above")
def high(block):
    block.simulate("-bias", "none")
    edit_csv(block.trajectory, moved("z", 80.0))
    return block.run("apply", block.strips()[0], "o.las", "-trajectory", block.trajectory,
                     "-bias", "boresight_roll=1")


@situation("range error by intensity, `calibrate`", "range_bias of the median intensity",
           r"median of the block|intensity_ranging")
def intensity(block):
    block.simulate("-error", "range_walk=0.04")
    status, text = block.calibrate()
    reason = block.result()["instrument"]["parameters"]["range_bias"].get("reason", "")
    return status, text + "\n" + reason


@situation("one trajectory sample of zeros, `apply`", "1 of the samples", r"left out|neighbours")
def bad_sample(block):
    block.simulate("-bias", "none")
    count = [0]

    def zero(row, columns):
        count[0] += 1
        if count[0] == 300:
            for name in ("x", "y", "z"):
                row[columns[name]] = "0"
        return row
    edit_csv(block.trajectory, zero)
    return block.run("apply", block.strips()[0], "o.las", "-trajectory", block.trajectory,
                     "-bias", "boresight_roll=1")


@situation("a corrected file is corrected again, `apply`", "corrected twice", r"-force")
def twice(block):
    block.simulate()
    block.calibrate()
    block.run("apply", block.strips()[0], "once.las", "-trajectory", block.trajectory,
              "-calibration", "c.json")
    return block.run("apply", "once.las", "twice.las", "-trajectory", block.trajectory,
                     "-calibration", "c.json")


@situation("flat drone strips, `icpatch`", "0: errors of the trajectory, centimetres",
           r"moved by 0\.0\d m in plan")
def drone(block):
    block.simulate("-ins", "tactical", "-bias", "none", preset="uav", scale=1.0, density=0.3)
    before, after = [], []
    edit(block.strips()[1], lambda records, _: before.append(records[["x", "y"]].copy()))
    status, text = block.run("icpatch", block.strips()[1], block.strips()[0], "-output", "r.json",
                             "-transformed", "moved.las")

    def keep(records, scale):
        after.append(scale)
        after.append(records[["x", "y"]].copy())
    edit(block.folder / "moved.las", keep)
    plan = [(after[1][axis] - before[0][axis].astype("f8")).mean() * after[0][k]
            for k, axis in enumerate("xy")]
    return status, text + f"moved by {math.hypot(*plan):.2f} m in plan\n"


@situation("heights of the trajectory in feet, `calibrate`", "factor 3.28",
           r"verdict: .*(feet|unit|height|trajectory)", r"verdict: usable")
def feet(block):
    block.simulate()

    def scale(row, columns):
        row[columns["z"]] = repr(float(row[columns["z"]]) / 0.3048)
        return row
    edit_csv(block.trajectory, scale)
    return block.calibrate()


@situation("coordinates that passed steps of 0.1 m, `calibrate`", "roll -90\" ± its std",
           r"steps of 0.1 m[\s\S]*largest error: [0-3]\.")
def coarse(block):
    block.simulate()

    def coarsen(records, scale):
        for name, step in (("x", scale[0]), ("y", scale[1]), ("z", scale[2])):
            units = round(0.1 / step)
            records[name] = numpy.round(records[name] / units).astype("i4") * units
    for strip in block.strips():
        edit(strip, coarsen)
    status, text = block.calibrate()
    return status, text + block.errors()


@situation("output over an input, `apply -report`", "nothing is lost", r"is also an input|input")
def over_input(block):
    block.simulate()
    return block.run("apply", block.strips()[0], block.trajectory, "-trajectory", block.trajectory,
                     "-bias", "boresight_roll=1")


def copy_as(number):
    def change(records, _):
        records["id"] = number
    return change


@situation("a copy of a strip under another id, `calibrate`", "9 is 2",
           r"9.*(copy|same points)[\s\S]*largest error: [0-2]\.")
def copied_strip(block):
    block.simulate()
    edit(block.strips()[1], copy_as(9), block.folder / "strip9.las")
    status, text = block.calibrate()
    return status, text + block.errors()


@situation("half of the control points 0.3 m high, `check`", "0.3 m between two groups",
           r"contradict.*0\.(29|30)\d? m")
def contradicting_control(block):
    block.simulate("-bias", "none")
    count = [0]

    def every_other(row, columns):
        count[0] += 1
        return moved("z", 0.3)(row, columns) if count[0] % 2 else row
    edit_csv(block.control, every_other)
    return block.check("-control", block.control)


def scanner_ids(records, _):
    records["id"] = 10 * records["id"] + ((records["flags"] >> 4) & 3)


@situation("two scanners with ids of their own, `calibrate`", "roll, pitch and heading -90\", ...",
           r"largest error: [0-2]\.\d", r"scanner2_\w+:")
def scanners_with_ids(block):
    block.simulate("-scanner", "dual")
    for strip in block.strips():
        edit(strip, scanner_ids)
    status, text = block.calibrate()
    return status, text + block.errors()


@situation("the same, one 60\" from the other, `calibrate`", "scanner 2 differs by 60\" in roll",
           r"scanner2.*roll.*differs by -?[56]\d", r"verdict: usable")
def different_scanners(block):
    block.simulate("-scanner", "dual", "-error", "channel1:boresight_roll=60")
    for strip in block.strips():
        edit(strip, scanner_ids)
    return block.calibrate()


@situation("headings of the trajectory from true north, the points from grid north, `calibrate`",
           "1.5°, harmless", r"verdict: usable[\s\S]*largest error: [0-2]\.\d")
def true_north(block):
    block.simulate()
    edit_csv(block.trajectory, moved("heading", 1.5))
    status, text = block.calibrate()
    return status, text + block.errors()


@situation("points from true north as well, `calibrate`", "heading 1.5°",
           r"boresight_heading is 1\.[45]\d degrees.*true north")
def points_from_true_north(block):
    block.simulate("-bias", "boresight_heading=5400")
    return block.calibrate()


@situation("one strip with ellipsoidal heights, `check`", "45.3 m",
           r"too far apart|no common surface|45\.3")
def ellipsoidal_strip(block):
    block.simulate("-bias", "none")
    edit(block.strips()[2], raised(45.3))
    return block.check()


def sentence(text, expected):
    """The line of a text that the expression finds, shortened."""
    found = re.search(expected, text)
    if not found:
        lines = [line.strip() for line in text.splitlines() if line.strip()]
        return lines[-1][:160] if lines else ""
    start = text.rfind("\n", 0, found.start()) + 1
    end = text.find("\n", found.start())
    return text[start:end if end > 0 else len(text)].strip()[:200]


PRESETS = {"paper": 0.15, "small": 0.5, "uav": 0.3, "corridor": 0.3, "conical": 0.4, "dual": 0.4,
           "rosette": 0.3, "mountain": 0.3, "city": 0.3}


def figures(build, seed):
    """Misfit as delivered, as stated of the corrected strips, and as measured on their files."""
    print("| preset | status | as delivered, m | stated, m | measured again, m | ratio | "
          "largest difference of a pair's mean, mm |\n|---|---|---|---|---|---|---|")
    failed = 0
    for preset, scale in PRESETS.items():
        folder = pathlib.Path(tempfile.mkdtemp(prefix="pcl_als_practice"))
        try:
            block = Block(build, folder, seed)
            block.simulate(preset=preset, scale=scale)
            status, _ = block.calibrate("-corrected", folder / "corrected")
            first = block.result()["report"]
            block.calibrate(files=sorted((folder / "corrected").glob("strip*.las")))
            again = block.result()["report"]
        finally:
            shutil.rmtree(folder)
        means = {(pair["a"], pair["b"]): pair["mean_before_m"] for pair in again["pairs"]}
        differences = [abs(means[pair["a"], pair["b"]] - pair["mean_after_m"])
                       for pair in first["pairs"] if (pair["a"], pair["b"]) in means]
        before, stated = first["misfit"]["rms_before_m"], first["misfit"]["rms_after_m"]
        measured = again["misfit"]["rms_before_m"]
        failed += not (abs(measured / stated - 1.0) < 0.05 and max(differences) < 0.01)
        print(f"| {preset} | {status} | {before:.4f} | {stated:.4f} | {measured:.4f} | "
              f"{measured / stated:.3f} | {1000.0 * max(differences):.1f} |", flush=True)
    return 1 if failed else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--only", default="", help="situations whose title holds this word")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--figures", action="store_true")
    arguments = parser.parse_args()
    if arguments.figures:
        return figures(arguments.build.resolve(), arguments.seed)
    print("| situation | truth | status | what the tool says | holds |\n|---|---|---|---|---|")
    failed = 0
    for title, truth, expected, forbidden, function in SITUATIONS:
        if arguments.only not in title and arguments.only != function.__name__:
            continue
        folder = pathlib.Path(tempfile.mkdtemp(prefix="pcl_als_practice"))
        try:
            status, text = function(Block(arguments.build.resolve(), folder, arguments.seed))
        finally:
            shutil.rmtree(folder)
        holds = bool(re.search(expected, text)) and not (forbidden and re.search(forbidden, text))
        failed += not holds
        said = sentence(text, expected).replace("|", "\\|").replace(str(folder) + "/", "")
        print(f"| {title} | {truth} | {status} | {said} | {'yes' if holds else 'NO'} |", flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    raise SystemExit(main())
