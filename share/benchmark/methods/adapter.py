# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""What the adapters of methods share: reading a block, and writing an entry.

An adapter is a program `NAME.py BLOCK ENTRY [--tools FOLDER]` that reads the folder of a block as
anybody gets it, never the truth, and writes the folder of an entry. It ends with status 77 and one
line where the method is not installed.
"""
import argparse
import json
import os
import pathlib
import resource
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import lasfile  # noqa: E402  (beside the folder of this file)

MISSING = 77


class Block:
    def __init__(self, folder):
        self.folder = folder
        self.about = json.loads((folder / "block.json").read_text())
        self.strips = [folder / strip["file"] for strip in self.about["strips"]]
        self.ids = [strip["id"] for strip in self.about["strips"]]
        self.trajectory = self._file("trajectory")
        self.control = self._file("control")

    def _file(self, key):
        return self.folder / self.about[key] if self.about[key] else None


def missing(reason):
    """Ends the adapter: the method is not installed."""
    print(reason, file=sys.stderr)
    sys.exit(MISSING)


def write_parameters(entry, about, stated):
    """stated: (value, std or None) by name; what was not asked is left out."""
    rows = ["name,value,std,unit"]
    for parameter in about["parameters"]:
        if parameter["name"] in stated:
            value, std = stated[parameter["name"]]
            rows.append(f"{parameter['name']},{value!r},{'' if std is None else repr(std)},"
                        f"{parameter['unit']}")
    (entry / "parameters.csv").write_text("\n".join(rows) + "\n")


def cpu_seconds():
    """Of this process and of those that it started and that have ended."""
    return sum(usage.ru_utime + usage.ru_stime for usage in map(
        resource.getrusage, (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)))


def run(work, description):
    """Calls work(block, entry, options), which returns method, version and perhaps a note, and
    writes entry.json with the time that it took."""
    parser = argparse.ArgumentParser(description=description.splitlines()[0])
    parser.add_argument("block", type=pathlib.Path)
    parser.add_argument("entry", type=pathlib.Path)
    parser.add_argument("--tools", type=pathlib.Path, help="folder of the tools of this project")
    parser.add_argument("--calibrated", type=pathlib.Path,
                        help="an entry whose calibration is used again")
    options = parser.parse_args()
    options.entry.mkdir(parents=True, exist_ok=True)
    start = time.monotonic()
    about = work(Block(options.block), options.entry, options)
    about.setdefault("seconds", round(time.monotonic() - start, 2))
    about.setdefault("cpu_seconds", round(cpu_seconds(), 2))
    about.setdefault("cores", len(os.sched_getaffinity(0)))
    (options.entry / "entry.json").write_text(json.dumps(about, indent=1) + "\n")
