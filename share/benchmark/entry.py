# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""Reads an entry for one block, and refuses what is wrong with one line that names the file."""
import csv
import json
import math
import pathlib

import numpy

from lasfile import LasFile, Unusable


def read_json(path):
    try:
        return json.loads(path.read_text())
    except OSError as error:
        raise Unusable(f"{path}: cannot be read: {error.strerror}") from error
    except ValueError as error:
        raise Unusable(f"{path}: is no JSON: {error}") from error


def read_rows(path, needed):
    """Rows of a CSV file as (line number, dictionary); needed: columns that it must have."""
    try:
        text = path.read_text()
    except (OSError, UnicodeDecodeError) as error:
        raise Unusable(f"{path}: cannot be read: {error}") from error
    reader = csv.DictReader(text.splitlines(), skipinitialspace=True)
    for column in needed:
        if column not in (reader.fieldnames or []):
            raise Unusable(f"{path}: has no column '{column}'")
    return [(reader.line_num, row) for row in reader]


def number(path, line, column, text):
    try:
        value = float(text)
    except (TypeError, ValueError):
        raise Unusable(f"{path}:{line}: {column} is no number: '{text}'") from None
    if not math.isfinite(value):
        raise Unusable(f"{path}:{line}: {column} is not finite: '{text}'")
    return value


def deviation(path, line, column, text):
    value = number(path, line, column, text)
    if value < 0.0:
        raise Unusable(f"{path}:{line}: {column} is negative: '{text}'")
    return value


def read_parameters(path, asked):
    """(value, std or None) by name."""
    units = {parameter["name"]: parameter["unit"] for parameter in asked}
    stated = {}
    for line, row in read_rows(path, ("name", "value", "unit")):
        name = (row["name"] or "").strip()
        if name not in units:
            raise Unusable(f"{path}:{line}: '{name}' is not asked in this block; asked are "
                           f"{', '.join(units)}")
        if name in stated:
            raise Unusable(f"{path}:{line}: {name} is stated twice")
        if (row["unit"] or "").strip() != units[name]:
            raise Unusable(f"{path}:{line}: {name} is asked in '{units[name]}', not in "
                           f"'{(row['unit'] or '').strip()}'")
        std = (row.get("std") or "").strip()
        stated[name] = (number(path, line, "value", row["value"]),
                        deviation(path, line, "std", std) if std else None)
    return stated


def read_common_deviations(path, strips):
    """Standard deviations that all points of a strip share, by the strip's id."""
    common = {}
    for line, row in read_rows(path, ("strip", "sigma_x", "sigma_y", "sigma_z")):
        sigma = [deviation(path, line, name, row[name])
                 for name in ("sigma_x", "sigma_y", "sigma_z")]
        ids = strips if row["strip"] == "*" else [row["strip"]]
        if not set(ids) <= set(strips):
            raise Unusable(f"{path}:{line}: there is no strip '{row['strip']}'")
        common.update((strip, sigma) for strip in ids)
    return common


def claimed(las, common):
    """Standard deviations of the points of a file, n x 3, or None."""
    names = ("sigma_x", "sigma_y", "sigma_z")
    columns = [las.extra(name) for name in names]
    if all(column is None for column in columns):
        plan, height = las.extra("sigma_horizontal"), las.extra("sigma_vertical")
        if plan is not None and height is not None:
            # The radial standard deviation in the plane, shared by two coordinates.
            names, columns = ("sigma_horizontal", "sigma_vertical"), [
                plan / math.sqrt(2.0), plan / math.sqrt(2.0), height]
        elif common is not None:
            return numpy.tile(common, (las.count, 1))
        else:
            return None
    for name, column in zip(names, columns):
        if column is None:
            raise Unusable(f"{las.path}: has extra bytes of a standard deviation, but no {name}")
        if numpy.any(column < 0.0):
            raise Unusable(f"{las.path}: {name} of point {int(numpy.argmax(column < 0.0))} is "
                           "negative")
    return numpy.stack(columns, axis=1).astype(float)


def read_points(path, true, common):
    """(true coordinates, stated ones, standard deviations or None) of a strip. true: the file of
    the true points, whose count and times the entry must have."""
    las, reference = LasFile(path), LasFile(true)
    if las.count != reference.count:
        raise Unusable(f"{path}: has {las.count} points, the strip that was given "
                       f"{reference.count}")
    times = las.time()
    if times is None:
        raise Unusable(f"{path}: has no GPS times, which the order of points is checked by")
    wrong = numpy.flatnonzero(~(numpy.abs(times - reference.time()) < 1e-5))
    if len(wrong):
        raise Unusable(f"{path}: {len(wrong)} points have other times than in the strip that was "
                       f"given, first point {wrong[0]}: keep all points in their order")
    return reference.xyz(), las.xyz(), claimed(las, common)


def read_entry(folder, block, truth):
    """What an entry states of a block: a dictionary with about (entry.json), parameters (None where
    it has none) and points (None, or a list by strip). block: block.json; truth: its folder."""
    folder = pathlib.Path(folder)
    about = read_json(folder / "entry.json")
    if not isinstance(about, dict) or not about.get("method"):
        raise Unusable(f"{folder / 'entry.json'}: has no 'method'")
    for key in ("seconds", "cpu_seconds", "cores"):
        if about.get(key) is not None and not (
                isinstance(about[key], (int, float)) and 0.0 <= about[key] < math.inf):
            raise Unusable(f"{folder / 'entry.json'}: '{key}' is no number")
    parameters = points = None
    if (folder / "parameters.csv").exists():
        parameters = read_parameters(folder / "parameters.csv", block["parameters"])
    ids = [strip["id"] for strip in block["strips"]]
    common = {}
    if (folder / "points.csv").exists():
        common = read_common_deviations(folder / "points.csv", ids)
    if (folder / "points").is_dir():
        points = []
        for strip in block["strips"]:
            name = pathlib.Path(strip["file"]).name
            if not (folder / "points" / name).exists():
                raise Unusable(f"{folder / 'points' / name}: is missing; a corrected copy of every "
                               "strip is needed, or no folder points")
            points.append(read_points(folder / "points" / name, truth / "points" / name,
                                      common.get(strip["id"])))
    if parameters is None and points is None:
        raise Unusable(f"{folder}: has neither parameters.csv nor a folder points")
    return {"about": about, "parameters": parameters, "points": points}
