#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""Calibration by discrete returns and by the echoes of decomposed waveforms of the same blocks.

    tests/benchmarks/waveform_calibration.py BUILD [--seeds FIRST:LAST] [options of pcl_als_simulate]

Prints Markdown tables: probability of slope_ranging, and RMS of error, of reported standard
deviation, and of error over standard deviation of each parameter, for discrete returns, for echoes
with the standard deviations of their ranges (range_std), and for echoes without them.
"""
import argparse
import json
import pathlib
import shutil
import subprocess
import tempfile

METHODS = ["returns", "echoes", "echoes, -no_range_std"]
UNITS = {"lever_arm_x": "m", "lever_arm_y": "m", "boresight_pitch": "arcsec",
         "boresight_roll": "arcsec", "boresight_heading": "arcsec", "range_bias": "m",
         "scan_angle_scale": ""}


def run(build, verb, *arguments):
    command = [str(part) for part in (build / f"bin/pcl_als_{verb}", *arguments, "-quiet")]
    status = subprocess.run(command, stdout=subprocess.DEVNULL, check=False).returncode
    if status not in (0, 3):
        raise RuntimeError(f"status {status}: {' '.join(command)}")


def calibrations(build, folder, seed, simulation):
    """The three results of a block, read from their files."""
    run(build, "simulate", "-output", folder, "-noise", "realistic", "-waveforms", "-seed", seed,
        *simulation)
    strips = sorted(folder.glob("strip*.las"))
    for strip in strips:
        run(build, "waveform", strip, folder / ("echoes_" + strip.name), "-move_returns",
            "-pulse_width", "4")
    echoes = sorted(folder.glob("echoes_strip*.las"))
    results = []
    for files, options in ((strips, ()), (echoes, ()), (echoes, ("-no_range_std",))):
        run(build, "calibrate", *files, "-trajectory", folder / "trajectory.csv", "-control",
            folder / "control.csv", "-output", folder / "c.json", *options)
        results.append(json.loads((folder / "c.json").read_text()))
    truth = json.loads((folder / "truth.json").read_text())["bias"]
    return results, {name.removesuffix("_arcsec").removesuffix("_m"): value
                     for name, value in truth.items()}


def rms(values):
    return (sum(value * value for value in values) / len(values)) ** 0.5 if values else float("nan")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--seeds", default="1:12")
    arguments, simulation = parser.parse_known_args()
    first, last = (int(part) for part in arguments.seeds.split(":"))
    estimates = {(method, name): [] for method in METHODS for name in UNITS}
    print("| seed | " + " | ".join("slope_ranging, " + method for method in METHODS) +
          " |\n|---|---|---|---|")
    for seed in range(first, last + 1):
        folder = pathlib.Path(tempfile.mkdtemp(prefix="pcl_als_waves"))
        try:
            results, truth = calibrations(arguments.build.resolve(), folder, seed, simulation)
        finally:
            shutil.rmtree(folder)
        row = []
        for method, result in zip(METHODS, results):
            slope = next(found for found in result["report"]["diagnosis"]
                         if found["source"] == "slope_ranging")
            row.append(f"{slope['value']:.3f} ± {slope['std']:.3f}, {slope['probability']:.2f}")
            for name in UNITS:
                found = result["instrument"]["parameters"][name]
                if found["status"] == "estimated":
                    estimates[method, name].append((found["bias"] - truth[name], found["std"]))
        print(f"| {seed} | " + " | ".join(row) + " |", flush=True)
    print("\n| parameter | " + " | ".join(METHODS) + " |\n|---|---|---|---|")
    for name, unit in UNITS.items():
        cells = []
        for method in METHODS:
            values = estimates[method, name]
            cells.append(f"{rms([e for e, _ in values]):.3g}, {rms([s for _, s in values]):.3g}, "
                         f"{rms([e / s for e, s in values]):.2f}")
        print(f"| {name} {unit} | " + " | ".join(cells) + " |")
    inside = [sum(abs(e) < 1.96 * s for name in UNITS for e, s in estimates[method, name])
              for method in METHODS]
    print("| within 95 % | " + " | ".join(
        f"{count} of {sum(len(estimates[method, name]) for name in UNITS)}"
        for method, count in zip(METHODS, inside)) + " |")


if __name__ == "__main__":
    main()
