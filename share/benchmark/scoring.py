# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""The figures of the benchmark, from arrays: no files, no names of blocks."""
import itertools

import numpy

ALPHA = 0.05
QUANTILE = 1.959963984540054  # of the normal distribution, at 1 - ALPHA / 2
LEAST_POINTS = 8              # of a strip in a cell


def interval_score(error, std):
    """Interval score of the central 95 % interval estimate +- QUANTILE std, in the unit of error
    (Gneiting and Raftery 2007, Eq. 43): its width and 2 / ALPHA times what the truth is outside."""
    half = QUANTILE * std
    return 2.0 * half + 2.0 / ALPHA * numpy.maximum(0.0, numpy.abs(error) - half)


def inside(error, std):
    return numpy.abs(error) <= QUANTILE * std


def score_parameters(asked, truth, stated):
    """asked: parameters of block.json; truth: value by name; stated: (value, std or None) by name.
    A parameter that is not stated counts as 0 with the prior's standard deviation. Returns
    (rows, summary); rms_error_mm, interval_score_mm: on the ground."""
    rows = []
    for parameter in asked:
        name, scale = parameter["name"], parameter["mm_per_unit"]
        value, std = stated.get(name, (0.0, parameter["prior_std"]))
        error = value - truth[name]
        row = {"name": name, "unit": parameter["unit"], "stated": name in stated, "error": error,
               "std": std, "error_mm": error * scale, "error_over_std": None, "inside": None,
               "interval_score_mm": None}
        if std is not None:
            row["inside"] = bool(inside(error, std))
            row["interval_score_mm"] = float(interval_score(error, std)) * scale
            row["error_over_std"] = error / std if std > 0.0 else None
        rows.append(row)
    claimed = [row for row in rows if row["std"] is not None]
    summary = {"asked": len(rows), "stated": sum(row["stated"] for row in rows),
               "rms_error_mm": rms([row["error_mm"] for row in rows]),
               "claimed": sum(row["stated"] for row in claimed),
               "inside": sum(row["inside"] for row in claimed if row["stated"])}
    complete = len(claimed) == len(rows)
    summary["interval_score_mm"] = float(numpy.mean(
        [row["interval_score_mm"] for row in rows])) if complete else None
    return rows, summary


def rms(values):
    return float(numpy.sqrt(numpy.mean(numpy.square(values))))


def cell_means(xyz, errors, cell):
    """Mean error of the points in each square cell of the ground plan: a dictionary."""
    keys = numpy.floor(xyz[:, :2] / cell).astype(numpy.int64)
    unique, place = numpy.unique(keys, axis=0, return_inverse=True)
    place = place.reshape(-1)
    count = numpy.bincount(place)
    sums = [numpy.bincount(place, errors[:, axis]) for axis in range(3)]
    means = numpy.stack(sums, axis=1) / count[:, None]
    return {tuple(key): mean for key, mean, n in zip(unique.tolist(), means, count)
            if n >= LEAST_POINTS}


def misfit(strips, cell):
    """RMS difference of the mean errors of two strips in the same cell, over all cells and pairs
    of strips: three-dimensional and in height, m; and the number of differences. strips: list of
    (true coordinates, errors)."""
    means = [cell_means(xyz, errors, cell) for xyz, errors in strips]
    differences = [a[key] - b[key] for a, b in itertools.combinations(means, 2)
                   for key in a.keys() & b.keys()]
    if not differences:
        return None, None, 0
    square = numpy.square(differences)
    return (float(numpy.sqrt(square.sum(axis=1).mean())), float(numpy.sqrt(square[:, 2].mean())),
            len(differences))


def score_points(strips, cell):
    """strips: list of (true coordinates, stated coordinates, standard deviations n x 3 or None), m.
    Standard deviations that are NaN are not claimed. Returns a dictionary, in mm."""
    errors = [stated - true for true, stated, _ in strips]
    every = numpy.concatenate(errors)
    length = numpy.linalg.norm(every, axis=1)
    rest = every - every.mean(axis=0)
    shifted = numpy.linalg.norm(rest, axis=1)
    apart, apart_height, cells = misfit(
        [(true, error) for (true, _, _), error in zip(strips, errors)], cell)
    summary = {
        "points": len(every), "rms_mm": 1e3 * rms(length), "p95_mm": 1e3 * percentile95(length),
        "rms_height_mm": 1e3 * rms(every[:, 2]),
        "translation_mm": (1e3 * every.mean(axis=0)).tolist(),
        "rms_shifted_mm": 1e3 * rms(shifted), "rms_height_shifted_mm": 1e3 * rms(rest[:, 2]),
        "misfit_mm": None if apart is None else 1e3 * apart,
        "misfit_height_mm": None if apart is None else 1e3 * apart_height, "cells": cells}
    summary.update(score_claims(errors, [std for _, _, std in strips]))
    return summary


def percentile95(values):
    return float(numpy.percentile(values, 95.0))


def score_claims(errors, claims):
    """Coverage and interval score of standard deviations of points, per coordinate."""
    pairs = [(error, std) for error, std in zip(errors, claims) if std is not None]
    total = sum(len(error) for error in errors)
    if not pairs:
        return {"claimed_share": 0.0}
    error = numpy.concatenate([error for error, _ in pairs])
    std = numpy.concatenate([std for _, std in pairs])
    known = numpy.isfinite(std).all(axis=1)
    error, std = error[known], std[known]
    if not len(std):
        return {"claimed_share": 0.0}
    hit, score = inside(error, std), 1e3 * interval_score(error, std)
    return {"claimed_share": len(std) / total,
            "coverage_plan": float(hit[:, :2].mean()), "coverage_height": float(hit[:, 2].mean()),
            "interval_score_plan_mm": float(score[:, :2].mean()),
            "interval_score_height_mm": float(score[:, 2].mean())}
