#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""pcl_als_calibrate with all that is given of a block, and pcl_als_apply.

Where no trajectory is given, pcl_als_trajectory makes it from the points. With --calibrated ENTRY
the calibration of that entry is used again, and the errors of the trajectory that it estimated are
corrected as well (-strip_corrections).
"""
import json
import shutil
import subprocess

import adapter
import tools

DONE, NO_RELIABLE_ANSWER = 0, 3


def run(options, verb, *arguments):
    """Status and text of a tool; what is wrong usage or unusable input ends the adapter."""
    command = [str(tools.find(f"pcl_als_{verb}", options.tools)), *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode not in (DONE, NO_RELIABLE_ANSWER):
        raise SystemExit(f"{' '.join(command)}\n{done.stderr}")
    return done.returncode, done.stdout + done.stderr


def systems_of(block):
    """Options for parts that have parameters of their own: channels, or days with a height."""
    parts = sorted({parameter["name"].split(":")[0] for parameter in block.about["parameters"]
                    if ":" in parameter["name"]})
    own = {parameter["name"].split(":")[1] for parameter in block.about["parameters"]
           if ":" in parameter["name"]}
    if not parts:
        return []
    own = ["offset" if name == "offset_z" else name for name in sorted(own)]
    if parts[0].startswith("channel"):
        everything = f"{block.ids[0]}-{block.ids[-1]}"
        names = [f"{part}={everything}:{part[len('channel'):]}" for part in parts]
        return ["-channels", "scanner_channel", "-systems", *names, "-own", ",".join(own)]
    names = []
    for part in parts:
        day = int(part[len("session"):])
        strips = [strip["id"] for strip in block.about["strips"] if strip["session"] == day]
        names.append(f"{part}={','.join(strips)}")
    return ["-systems", *names, "-own", ",".join(own)]


def trajectory_of(block, entry, options):
    """That which is given, or one from the points."""
    if block.trajectory:
        return block.trajectory
    path = (options.calibrated or entry) / "trajectory.csv"
    if not options.calibrated:
        run(options, "trajectory", *block.strips, "-output", path)
    return path


def calibrate(block, entry, options, trajectory):
    """Writes calibration.json; returns the status."""
    sheet = block.about["data_sheet"]
    priors = ",".join(f"{p['name']}=0:{p['prior_std']}" for p in block.about["parameters"]
                      if ":" not in p["name"] and p["name"] != "time_offset")
    status, text = run(
        options, "calibrate", *block.strips, "-trajectory", trajectory, "-control", block.control,
        "-range_noise", sheet["range_m"], "-position_sigma", sheet["position_m"],
        "-roll_pitch_sigma", sheet["roll_pitch_arcsec"], "-heading_sigma", sheet["heading_arcsec"],
        "-prior", priors, *systems_of(block), "-output", entry / "calibration.json")
    (entry / "calibrate.txt").write_text(text)
    return status


def estimates(calibration):
    """(value, std) of all parameters that were estimated, as the benchmark names them."""
    found = {}

    def add(prefix, parameters):
        for name, estimate in parameters.items():
            if estimate["status"] == "estimated":
                found[prefix + name] = (estimate["bias"], estimate["std"])
    add("", calibration["instrument"]["parameters"])
    for system in calibration["instrument"].get("systems") or []:
        add(system["name"] + ":", system["parameters"])
        found[system["name"] + ":offset_z"] = (system["offset_m"][2], system["offset_std_m"][2])
    for source in calibration["report"].get("diagnosis", []):  # none without pairs
        if source["source"] == "time_offset" and source.get("determined"):
            found["time_offset"] = (source["value"], source["std"])
    return found


def work(block, entry, options):
    note, spent, cpu = "", 0.0, 0.0
    if options.calibrated:
        trajectory = trajectory_of(block, entry, options)
        shutil.copyfile(options.calibrated / "calibration.json", entry / "calibration.json")
        earlier = json.loads((options.calibrated / "entry.json").read_text())
        status, spent, cpu = (earlier[key] for key in (
            "status", "calibration_seconds", "calibration_cpu_seconds"))
    else:
        start = adapter.time.monotonic()
        trajectory = trajectory_of(block, entry, options)
        status = calibrate(block, entry, options, trajectory)
        spent, cpu = adapter.time.monotonic() - start, adapter.cpu_seconds()
    calibration = json.loads((entry / "calibration.json").read_text())
    adapter.write_parameters(entry, block.about, estimates(calibration))
    start, before = adapter.time.monotonic(), adapter.cpu_seconds()
    points = entry / "points"
    shutil.rmtree(points, ignore_errors=True)
    if status == DONE:
        run(options, "apply", *block.strips, "-corrected", points, "-trajectory", trajectory,
            "-calibration", entry / "calibration.json", "-uncertainty",
            *(["-strip_corrections"] if options.calibrated else []))
    else:
        note = "not applied: the verdict is that the result is not reliable"
        points.mkdir()
        for strip in block.strips:
            shutil.copyfile(strip, points / strip.name)
    return {"method": "pcl_als" + (" with strip corrections" if options.calibrated else ""),
            "version": calibration["tool_version"], "note": note, "status": status,
            "calibration_seconds": round(spent, 2), "calibration_cpu_seconds": round(cpu, 2),
            "seconds": round(spent + adapter.time.monotonic() - start, 2),
            "cpu_seconds": round(cpu + adapter.cpu_seconds() - before, 2)}


if __name__ == "__main__":
    adapter.run(work, __doc__)
