#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""Makes the blocks of the benchmark and their truth, with fixed seeds.

    generate.py OUTPUT [--tools FOLDER] [--only BLOCK,...] [--thin FACTOR] [--threads N]

OUTPUT/blocks/NAME is what entrants get, OUTPUT/truth/NAME what the scorer needs, and
OUTPUT/entries/true_parameters/NAME the strips as exact parameters would correct them, with the
errors of the trajectory and the noise still in them. --tools: where pcl_als_simulate is (default:
the build folder beside this script, else the search path). --thin: factor on the density,
for tests.
"""
import argparse
import dataclasses
import json
import math
import pathlib
import shutil
import subprocess
import tempfile

import numpy

import blocks
import lasfile
import tools


def simulate(program, arguments, folder, threads):
    command = [program, "-output", folder, *arguments, "-threads", str(threads), "-quiet"]
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True,
                          check=False)
    if done.returncode:
        raise SystemExit(f"generate.py: {' '.join(map(str, command))}\n{done.stderr}")


def columns(las, name):
    return numpy.stack([las.extra(f"{name}_{axis}") for axis in "xyz"], axis=1)


def split_truth(given, erring, truth, perfect):
    """From a strip with columns of its errors: the true points, and those of true parameters.
    Checks that the strip which is given has the same points."""
    las, same = lasfile.LasFile(erring), lasfile.LasFile(given)
    xyz = las.xyz()
    if not (numpy.array_equal(xyz, same.xyz()) and numpy.array_equal(las.time(), same.time())):
        raise SystemExit(f"generate.py: {given}: differs from {erring}")
    same.set_xyz(xyz - columns(las, "error"))
    same.write(truth)
    same.set_xyz(xyz - columns(las, "bias"))
    same.write(perfect)
    return same.count


def description(block, simulated, points):
    """The content of block.json."""
    flown = simulated["strips"]
    angle = math.radians(simulated["field_of_view_deg"])
    height = sum(strip["height_m"] for strip in flown) / len(flown)
    speed = sum(strip["speed_m_s"] for strip in flown) / len(flown)
    noise = simulated["noise"]
    return {
        "format": "strip adjustment benchmark block", "version": 1, "name": block.name,
        "title": block.title, "crs": simulated["crs"],
        "strips": [{"id": strip["id"], "file": f"strips/{strip['file']}", "points": count,
                    "session": strip["session"], "height_m": strip["height_m"],
                    "course_deg": strip["course_deg"], "speed_m_s": strip["speed_m_s"]}
                   for strip, count in zip(flown, points)],
        "trajectory": "trajectory.csv" if block.trajectory else None,
        "control": "control.csv",
        "scanner": {**simulated["scanner"], "field_of_view_deg": simulated["field_of_view_deg"],
                    "beam_divergence_mrad": simulated["beam_divergence_mrad"]},
        "data_sheet": {"range_m": noise["range_m"],
                       "scan_angle_arcsec": noise["scan_angle_arcsec"],
                       "control_m": noise["control_m"], "ins": block.ins,
                       **{key: noise["trajectory"][key] for key in
                          ("position_m", "roll_pitch_arcsec", "heading_arcsec")}},
        "parameters": [
            {"name": name, "unit": blocks.UNITS[name.split(":")[-1]], "prior_std": sigma,
             "mm_per_unit": round(blocks.millimetres_per_unit(name, height, angle, speed), 4)}
            for name, sigma in blocks.parameters_of(block).items()],
        "cell_m": block.cell}


def generate(block, output, program, threads=0, thin=1.0):
    """Makes one block; the folders are replaced."""
    given, truth = output / "blocks" / block.name, output / "truth" / block.name
    perfect = output / "entries" / "true_parameters" / block.name
    for folder in (given, truth, perfect):
        shutil.rmtree(folder, ignore_errors=True)
    block = dataclasses.replace(block, density=block.density * thin)
    values = blocks.truth_of(block)
    arguments = blocks.simulation_of(block, values)
    with tempfile.TemporaryDirectory(dir=output) as scratch:
        erring, strips = pathlib.Path(scratch) / "erring", pathlib.Path(scratch) / "strips"
        simulate(program, arguments + ["-truth_points", "-true_surface"], erring, threads)
        simulate(program, arguments, strips, threads)
        simulated = json.loads((strips / "truth.json").read_text())
        points = [split_truth(strips / strip["file"], erring / strip["file"],
                              truth / "points" / strip["file"], perfect / "points" / strip["file"])
                  for strip in simulated["strips"]]
        (given / "strips").mkdir(parents=True)
        for strip in simulated["strips"]:
            shutil.move(strips / strip["file"], given / "strips" / strip["file"])
        for name in ("trajectory.csv", "control.csv"):
            if name != "trajectory.csv" or block.trajectory:
                shutil.move(strips / name, given / name)
        shutil.move(strips / "truth.json", truth / "simulation.json")
    about = description(block, simulated, points)
    (given / "block.json").write_text(json.dumps(about, indent=1) + "\n")
    rows = [f"{p['name']},{values[p['name']]!r},{p['unit']}" for p in about["parameters"]]
    (truth / "parameters.csv").write_text("\n".join(["name,value,unit", *rows]) + "\n")
    (perfect / "entry.json").write_text(json.dumps(
        {"method": "true parameters, trajectory as delivered", "version": "-"}) + "\n")
    return sum(points)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("output", type=pathlib.Path)
    parser.add_argument("--tools", type=pathlib.Path)
    parser.add_argument("--only", default="", help="names of blocks, separated by commas")
    parser.add_argument("--thin", type=float, default=1.0)
    parser.add_argument("--threads", type=int, default=0)
    options = parser.parse_args()
    options.output.mkdir(parents=True, exist_ok=True)
    program = tools.find("pcl_als_simulate", options.tools)
    for block in tools.chosen(options.only):
        count = generate(block, options.output, program, options.threads, options.thin)
        print(f"{block.name}: {count} points", flush=True)


if __name__ == "__main__":
    main()
