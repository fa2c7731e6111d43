#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""reconstructed_calibration.py BIN_DIR FOLDER FIRST:LAST [PRESET [DENSITY]]: simulates blocks of
these seeds with realistic noise, calibrates each with its trajectory, with its trajectory but only
the parameters that a reconstructed trajectory can determine, and with the one reconstructed from its
points. Prints the estimates of the last, their deviations from the truth in standard deviations, and
the misfit of the strips after the correction; see trajectory_reconstruction.md."""
import json
import pathlib
import subprocess
import sys

NAMES = ["boresight_pitch", "boresight_roll", "boresight_heading", "scan_angle_scale"]


def run(tool, *arguments):
    done = subprocess.run([f"{sys.argv[1]}/pcl_als_{tool}", *map(str, arguments), "-quiet"],
                          capture_output=True, text=True)
    if done.returncode not in (0, 3):
        sys.exit(done.stderr)


def misfit(result, key):
    """RMS of the normal distances of all pairs, millimetres."""
    pairs = result["report"]["pairs"]
    count = sum(pair["correspondences"] for pair in pairs)
    return 1e3 * (sum(pair["correspondences"] * pair[key] ** 2 for pair in pairs) / count) ** 0.5


def main():
    folder = pathlib.Path(sys.argv[2])
    first, last = map(int, sys.argv[3].split(":"))
    seeds = last - first + 1
    preset = sys.argv[4] if len(sys.argv) > 4 else "small"
    density = sys.argv[5] if len(sys.argv) > 5 else "1"
    inside, squares = dict.fromkeys(NAMES, 0), dict.fromkeys(NAMES, 0.0)
    worse = [[], [], []]
    print("seed  " + "  ".join(f"{name} (std)" for name in NAMES) + "  RMS (mm) own, own with "
          "the parameters of the reconstructed, reconstructed; own and reconstructed with strip corrections")
    for seed in range(first, last + 1):
        block = folder / f"block{seed}"
        run("simulate", "-output", block, "-preset", preset, "-noise", "realistic", "-seed", seed,
            "-density", density)
        truth = json.loads((block / "truth.json").read_text())["bias"]
        strips = sorted(block.glob("strip*.las"))
        fits, corrected, line = [], [], f"{seed:4d}"
        output = folder / "calibration.json"
        for trajectory, options in ((block / "trajectory.csv", []),
                                    (block / "trajectory.csv", ["-estimate", ",".join(NAMES)]),
                                    ("reconstruct", [])):
            run("calibrate", *strips, "-trajectory", trajectory, "-model", "quasi_rigorous",
                "-control", block / "control.csv", "-output", output, *options)
            result = json.loads(output.read_text())
            fits.append(misfit(result, "rms_after_m"))
            corrected.append(misfit(result, "rms_strip_corrections_m"))
        for name in NAMES:
            estimate = result["instrument"]["parameters"][name]
            value = truth[name] if name in truth else truth[name + "_arcsec"]
            if estimate["status"] != "estimated":
                line += "  " + estimate["status"]
                continue
            deviation = (estimate["bias"] - value) / estimate["std"]
            inside[name] += abs(deviation) < 1.96
            squares[name] += deviation ** 2 / seeds
            line += f"  {estimate['bias']:.5g} ({deviation:+.2f})"
        print(line + "  %.1f %.1f %.1f; %.1f %.1f" % (*fits, corrected[0], corrected[2]), flush=True)
        worse[0].append(fits[2] - fits[0])
        worse[1].append(fits[2] - fits[1])
        worse[2].append(corrected[2] - corrected[0])
        for file in block.iterdir():
            file.unlink()
        block.rmdir()
    for name in NAMES:
        print(f"{name}: within the 95 % interval {inside[name]} of {seeds}, RMS of error / std "
              f"{squares[name] ** 0.5:.2f}")
    for name, values in zip(("", ", same parameters", ", strip corrections"), worse):
        print(f"misfit{name}: larger by %.1f mm (median), at most %.1f mm; at most 3 mm in %d" % (
            sorted(values)[len(values) // 2], max(values), sum(v <= 3.0 for v in values)))


main()
