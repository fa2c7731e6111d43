#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""The whole benchmark: blocks, methods, scores and the table of results.

    run.py [OUTPUT] [--tools FOLDER] [--only BLOCK,...] [--methods NAME,...] [--results FILE]
           [--thin FACTOR] [--entries FOLDER] [--keep]

OUTPUT (default: benchmark_run) holds blocks, truth, entries and scores. Blocks that are there are
not made again, and with --keep entries and scores neither. --entries: a folder of further entries,
one folder each, which are scored as well. A method that is not installed is left out with
one line. Exit status: 0 done, 1 if a method failed.
"""
import argparse
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time

import generate
import results
import score
import tools
from lasfile import Unusable

METHODS = {"nothing": ["nothing.py"], "pcl_als": ["pcl_als.py"],
           "pcl_als_strips": ["pcl_als.py", "--calibrated", "{entries}/pcl_als/{block}"],
           "simpleICP": ["simple_icp.py"], "small_gicp": ["gicp_small.py"],
           "Open3D": ["open3d_icp.py"], "lidar-strip-adjust": ["strip_adjust.py"]}
PERFECT = "true_parameters"  # the entry that generate.py makes
MISSING = 77
LONGEST = 3600  # seconds that a method may take for a block


def run_method(name, block, output, folder):
    """Runs an adapter for a block. Returns None, or why there is no entry."""
    here, entries = pathlib.Path(__file__).resolve().parent, output / "entries"
    entry = entries / name / block
    shutil.rmtree(entry, ignore_errors=True)
    script, *arguments = [part.format(entries=entries, block=block) for part in METHODS[name]]
    command = [sys.executable, str(here / "methods" / script), str(output / "blocks" / block),
               str(entry), *arguments]
    if folder:
        command += ["--tools", str(folder)]
    # In a group of its own, so that what it started ends with it.
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                          cwd=output, start_new_session=True) as process:
        try:
            errors = process.communicate(timeout=LONGEST)[1].strip()
        except BaseException as stopped:
            os.killpg(process.pid, signal.SIGKILL)
            if isinstance(stopped, subprocess.TimeoutExpired):
                return f"not done after {LONGEST} s"
            raise
    if process.returncode == MISSING:
        raise LookupError(errors)
    return (errors.splitlines() or ["failed"])[-1] if process.returncode else None


def make_blocks(options, chosen):
    program = tools.find("pcl_als_simulate", options.tools)
    for block in chosen:
        if (options.output / "blocks" / block.name / "block.json").exists():
            continue
        start = time.monotonic()
        count = generate.generate(block, options.output, program, thin=options.thin)
        print(f"{block.name}: {count} points, {time.monotonic() - start:.1f} s", flush=True)


def run_methods(options, chosen):
    """Runs all methods; returns (failures by (method, block), reasons of those left out)."""
    failures, left_out = {}, {}
    for name in options.methods:
        for block in chosen:
            start = time.monotonic()
            if options.keep and (options.output / "entries" / name / block.name /
                                 "entry.json").exists():
                continue
            try:
                reason = run_method(name, block.name, options.output, options.tools)
            except LookupError as error:
                left_out[name] = str(error)
                print(f"{name}: left out: {error}", flush=True)
                break
            if reason:
                failures[name, block.name] = reason
            print(f"{name}, {block.name}: {reason or 'done'}, {time.monotonic() - start:.1f} s",
                  flush=True)
    return failures, left_out


def scored(entry, block, options):
    """The scores of an entry for a block; with --keep those that are there."""
    kept = options.output / "scores" / entry.name / f"{block}.json"
    if options.keep and kept.exists():
        return json.loads(kept.read_text())
    one = {"entry": entry.name, **score.score_block(options.output, block, entry / block)}
    kept.parent.mkdir(parents=True, exist_ok=True)
    score.write(kept, one)
    return one


def score_all(options, chosen, failures):
    """Scores of every entry for every block."""
    scores, entries = [], options.output / "entries"
    for entry in [entries / name for name in (*options.methods, PERFECT)] + options.further:
        for block in chosen:
            if not (entry / block.name).is_dir() or (entry.name, block.name) in failures:
                continue
            try:
                scores.append(scored(entry, block.name, options))
            except Unusable as error:
                failures[entry.name, block.name] = str(error)
                print(error, flush=True)
                continue
            print(f"{entry.name}: {score.line(scores[-1])}", flush=True)
    return scores


def options_of():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("output", type=pathlib.Path, nargs="?", default="benchmark_run")
    parser.add_argument("--tools", type=pathlib.Path)
    parser.add_argument("--only", default="", help="names of blocks, separated by commas")
    parser.add_argument("--methods", default=",".join(METHODS),
                        help="names of methods, separated by commas")
    parser.add_argument("--results", type=pathlib.Path, help="page to write (default: in OUTPUT)")
    parser.add_argument("--thin", type=float, default=1.0, help="factor on the density, for tests")
    parser.add_argument("--keep", action="store_true", help="keep entries that are there")
    parser.add_argument("--entries", type=pathlib.Path, help="folder of further entries")
    options = parser.parse_args()
    options.output = options.output.resolve()
    options.output.mkdir(parents=True, exist_ok=True)
    options.tools = options.tools.resolve() if options.tools else None
    options.results = options.results or options.output / "results.md"
    options.methods = options.methods.split(",")
    for name in options.methods:
        if name not in METHODS:
            parser.error(f"method '{name}' is not known; there are {', '.join(METHODS)}")
    options.further = sorted(path for path in options.entries.resolve().iterdir()
                             if path.is_dir()) if options.entries else []
    return options


def main():
    options, start = options_of(), time.monotonic()
    chosen = tools.chosen(options.only)
    make_blocks(options, chosen)
    failures, left_out = run_methods(options, chosen)
    scores = score_all(options, chosen, failures)
    score.write(options.output / "scores.json", scores)
    results.write(options.results, scores, failures, left_out, chosen)
    print(f"{options.results} written after {(time.monotonic() - start) / 60.0:.1f} minutes")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
