#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""Scores an entry of the benchmark.

    score.py BENCHMARK ENTRY [--only BLOCK,...] [--output scores.json]

BENCHMARK: the folder that generate.py wrote, with blocks and truth; ENTRY: a folder with one folder
per block. Prints a summary; --output has every figure. Exit status: 0 done, 2 an entry that cannot
be scored, with one line that names the file.
"""
import argparse
import json
import pathlib
import sys

import entry as entries
import scoring
from lasfile import Unusable


def score_block(benchmark, name, folder):
    """All figures of an entry for one block."""
    block = entries.read_json(benchmark / "blocks" / name / "block.json")
    truth = benchmark / "truth" / name
    found = entries.read_entry(folder, block, truth)
    scores = {"block": name, **{key: found["about"].get(key) for key in
                                ("method", "version", "seconds", "cpu_seconds", "cores", "note")}}
    if found["parameters"] is not None:
        values = {row["name"]: float(row["value"])
                  for _, row in entries.read_rows(truth / "parameters.csv", ("name", "value"))}
        scores["rows"], scores["parameters"] = scoring.score_parameters(
            block["parameters"], values, found["parameters"])
    if found["points"] is not None:
        scores["points"] = scoring.score_points(found["points"], block["cell_m"])
    return scores


def blocks_of(benchmark, folder, only):
    """Names of the blocks that an entry has a folder for."""
    if not (benchmark / "blocks").is_dir():
        raise Unusable(f"{benchmark}: has no folder blocks; make it with generate.py")
    known = sorted(path.parent.name for path in (benchmark / "blocks").glob("*/block.json"))
    names = only.split(",") if only else [name for name in known if (folder / name).is_dir()]
    for name in names:
        if name not in known:
            raise Unusable(f"{benchmark}/blocks: has no block '{name}'")
    if not names:
        raise Unusable(f"{folder}: has no folder of a block; there are {', '.join(known)}")
    return names


def write(path, scores):
    """Complete or not at all."""
    part = path.with_name(path.name + ".part")
    part.write_text(json.dumps(scores, indent=1) + "\n")
    part.replace(path)


def text(value, digits=1):
    return "-" if value is None else f"{value:.{digits}f}"


def line(scores):
    parts = [f"{scores['block']}:"]
    p = scores.get("parameters")
    if p:
        parts.append(f"parameters {p['stated']} of {p['asked']} stated, RMS "
                     f"{p['rms_error_mm']:.1f} mm, {p['inside']} of {p['claimed']} in 95 %, "
                     f"interval score {text(p['interval_score_mm'])} mm;")
    q = scores.get("points")
    if q:
        parts.append(f"points RMS {q['rms_mm']:.1f} mm, height {q['rms_height_mm']:.1f} mm, "
                     f"without translation {q['rms_shifted_mm']:.1f} mm, between strips "
                     f"{text(q['misfit_mm'])} mm;")
        if q["claimed_share"] > 0.0:
            parts.append(f"in 95 %: plan {100 * q['coverage_plan']:.1f} %, height "
                         f"{100 * q['coverage_height']:.1f} %;")
    return " ".join(parts + [f"{text(scores['seconds'])} s"])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("benchmark", type=pathlib.Path)
    parser.add_argument("entry", type=pathlib.Path)
    parser.add_argument("--only", default="", help="names of blocks, separated by commas")
    parser.add_argument("--output", type=pathlib.Path)
    options = parser.parse_args()
    try:
        scores = [score_block(options.benchmark, name, options.entry / name)
                  for name in blocks_of(options.benchmark, options.entry, options.only)]
    except Unusable as error:
        print(f"score.py: {error}", file=sys.stderr)
        return 2
    for one in scores:
        print(line(one))
    if options.output:
        write(options.output, scores)
    return 0


if __name__ == "__main__":
    sys.exit(main())
