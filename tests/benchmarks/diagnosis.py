#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""How often the diagnosis of a calibration finds the error sources of simulated blocks.

    tests/benchmarks/diagnosis.py BUILD [--seeds FIRST:LAST] [--preset small] [--parts]

Every block has none, one or two error sources of random kind and size. Prints Markdown tables: how
often each source is found where it is present and where it is not, and the errors of its value over
its standard deviation. Deterministic for a range of seeds.
"""
import argparse
import json
import math
import pathlib
import random
import shutil
import subprocess
import tempfile

ARCSEC = math.pi / 648000.0

# Name of the simulator, smallest and largest size in its unit, name in the diagnosis, and the value
# there (interface unit) for a size and the largest scan angle (radians).
SOURCES = [
    ("time_offset", 3.0, 10.0, "time_offset", lambda size, angle: size),
    # The simulator's sign is positive for a scan to the right.
    ("mirror_torsion", 3.0, 30.0, "mirror_torsion", lambda size, angle: -size),
    ("encoder_cubic", 0.0015, 0.009, "encoder_cubic",
     lambda size, angle: 0.4 * size * angle**3 / ARCSEC),
    ("encoder_quadratic", 0.0003, 0.0018, "encoder_quadratic",
     lambda size, angle: size * angle**2 * 2.0 / 3.0 / ARCSEC),
    ("range_walk", 0.01, 0.04, "intensity_ranging", lambda size, angle: -size / math.log(10.0)),
    ("range_scale", 1.5e-4, 4e-4, "range_scale", lambda size, angle: 1e6 * size),
    # Shares of the stretch of the simulated beam (0.33 mrad) and of the model's (0.3 mrad).
    ("range_incidence", 0.05, 0.15, "slope_ranging", lambda size, angle: 1.1 * size),
]

# With --parts: errors of parts of a block, which is flown on two days.
PARTS = [
    ("strip3:jump_z", 0.06, 0.2, "trajectory_jump", lambda size, angle: size),
    ("session2:offset_z", 0.06, 0.2, "session2_offset_up", lambda size, angle: size),
    ("session2:boresight_roll", 30.0, 120.0, "session2_boresight_roll", lambda size, angle: size),
]


def drawn(seed):
    """The error sources of a block: (index in SOURCES, size), none, one or two."""
    generator = random.Random(seed)
    kinds = generator.sample(range(len(SOURCES)), generator.randint(0, 2))
    result = []
    for kind in kinds:
        size = generator.uniform(*SOURCES[kind][1:3])
        positive = SOURCES[kind][0] == "range_incidence" or generator.random() < 0.5
        result.append((kind, size if positive else -size))
    return result


def run(command):
    done = subprocess.run([str(part) for part in command], stdout=subprocess.DEVNULL,
                          stderr=subprocess.PIPE, text=True, check=False)
    if done.returncode not in (0, 3):
        raise SystemExit(f"{command[0]}: {done.stderr}")


def calibrated(build, preset, seed, errors, folder, sessions):
    """The calibration.json of a block."""
    simulate = [build / "bin/pcl_als_simulate", "-preset", preset, "-noise", "realistic", "-seed",
                seed, "-sessions", sessions, "-output", folder]
    for kind, size in errors:
        simulate += ["-error", f"{SOURCES[kind][0]}={size:.9g}"]
    run(simulate)
    result = folder / "calibration.json"
    run([build / "bin/pcl_als_calibrate", *sorted(folder.glob("strip*.las")), "-trajectory",
         folder / "trajectory.csv", "-control", folder / "control.csv", "-output", result, "-quiet"])
    return json.loads(result.read_text())


class Tally:
    def __init__(self):
        self.present, self.found, self.supported = 0, 0, 0
        self.absent, self.false = 0, 0
        self.scores = []

    def add(self, true_value, finding):
        if true_value is None:
            self.absent += 1
            self.false += finding["probability"] > 0.5 and finding["determined"]
            return
        self.present += 1
        self.found += finding["probability"] > 0.9
        self.supported += finding["probability"] > 0.5
        self.scores.append((finding["value"] - true_value) / finding["std"])

    def row(self, name):
        scores = self.scores or [math.nan]
        rms = math.sqrt(sum(z * z for z in scores) / len(scores))
        inside = sum(abs(z) < 1.96 for z in scores)
        return (f"| {name} | {self.present} | {self.found} | {self.supported} | {self.absent} | "
                f"{self.false} | {rms:.2f} | {inside} of {len(self.scores)} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--seeds", default="1:40")
    parser.add_argument("--preset", default="small")
    parser.add_argument("--parts", action="store_true",
                        help="also jumps of the trajectory and differences of the second day")
    options = parser.parse_args()
    if options.parts:
        SOURCES.extend(PARTS)
    first, last = (int(part) for part in options.seeds.split(":"))
    tallies = {source[3]: Tally() for source in SOURCES}
    blocks_with_false = 0
    for seed in range(first, last + 1):
        errors = drawn(seed)
        with tempfile.TemporaryDirectory() as scratch:
            folder = pathlib.Path(scratch) / "block"
            result = calibrated(options.build.resolve(), options.preset, seed, errors, folder,
                                2 if options.parts else 1)
            shutil.rmtree(folder)
        angle = math.radians(result["instrument"]["error_sources"]["largest_scan_angle_deg"])
        truth = {SOURCES[kind][3]: SOURCES[kind][4](size, angle) for kind, size in errors}
        false = False
        for finding in result["report"]["diagnosis"]:
            name = finding["source"]
            if name not in tallies:
                continue
            tallies[name].add(truth.get(name), finding)
            false |= name not in truth and finding["probability"] > 0.5
        blocks_with_false += false
        print(f"<!-- {seed}: {truth} found " + ", ".join(
            f"{f['source']} {f['probability']:.3f} {f['value']:.4g}" for f in result["report"]["diagnosis"]
            if f["source"] in tallies and (f["probability"] > 0.5 or f["source"] in truth)) +
            " -->", flush=True)
    print("\n| source | present in blocks | probability > 0.9 | > 0.5 | absent in blocks | "
          "probability > 0.5 | RMS of error / std | within 95 % |")
    print("|---|---|---|---|---|---|---|---|")
    for name, tally in tallies.items():
        print(tally.row(name))
    print(f"\nBlocks with a source that is not present at a probability above 0.5: "
          f"{blocks_with_false} of {last - first + 1}")


if __name__ == "__main__":
    main()
