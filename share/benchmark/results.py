# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""The page of results, from scores."""
import math
import textwrap

HEAD = """# Results of the strip adjustment benchmark

Written by `run.py`; [README.md](README.md) defines every figure. Millimetres; "in 95 %" is the
share of true values inside the stated 95 % intervals, which should be 95 %.
"""


def text(value, digits=1):
    return "-" if value is None else f"{value:.{digits}f}"


def percent(value):
    return "-" if value is None else f"{100.0 * value:.1f}"


def mean_square(values):
    values = [value for value in values if value is not None]
    return math.sqrt(sum(v * v for v in values) / len(values)) if values else None


def mean(values):
    values = [value for value in values if value is not None]
    return sum(values) / len(values) if values else None


def table(head, rows):
    return "\n".join(["| " + " | ".join(head) + " |", "|---" * len(head) + "|",
                      *("| " + " | ".join(row) + " |" for row in rows)]) + "\n"


def column(scores, group, key):
    return [one.get(group, {}).get(key) for one in scores]


def summary(scores, failures, entries):
    """One row per method, over all blocks that it has an entry for."""
    head = ["method", "blocks", "parameters: stated", "RMS", "in 95 %", "interval score",
            "points: RMS", "height", "without translation", "between strips", "in 95 %, plan",
            "height", "interval score, plan", "height", "CPU s"]
    rows = []
    for entry in entries:
        own = [one for one in scores if one["entry"] == entry]
        stated = sum(filter(None, column(own, "parameters", "stated")))
        asked = sum(filter(None, column(own, "parameters", "asked")))
        claimed = sum(filter(None, column(own, "parameters", "claimed")))
        hits = sum(filter(None, column(own, "parameters", "inside")))
        failed = sum(name == entry for name, _ in failures)
        rows.append([entry, f"{len(own)}" + (f", {failed} failed" if failed else ""),
                     f"{stated} of {asked}" if asked else "-",
                     text(mean_square(column(own, "parameters", "rms_error_mm"))),
                     percent(hits / claimed) if claimed else "-",
                     text(mean(column(own, "parameters", "interval_score_mm"))),
                     *(text(mean_square(column(own, "points", key))) for key in
                       ("rms_mm", "rms_height_mm", "rms_shifted_mm", "misfit_mm")),
                     *(percent(mean(column(own, "points", key)))
                       for key in ("coverage_plan", "coverage_height")),
                     *(text(mean(column(own, "points", key)))
                       for key in ("interval_score_plan_mm", "interval_score_height_mm")),
                     text(mean([one["cpu_seconds"] for one in own]))])
    return table(head, rows)


def block_table(scores):
    head = ["method", "parameters: stated", "RMS", "in 95 %", "interval score", "points: RMS",
            "95th percentile", "height", "without translation", "height", "between strips",
            "in 95 %, plan", "height", "interval score, plan", "height", "CPU s"]
    rows = []
    for one in scores:
        p, q = one.get("parameters", {}), one.get("points", {})
        rows.append([one["entry"], f"{p['stated']} of {p['asked']}" if p else "-",
                     text(p.get("rms_error_mm")), f"{p['inside']} of {p['claimed']}" if p else "-",
                     text(p.get("interval_score_mm")),
                     *(text(q.get(key)) for key in
                       ("rms_mm", "p95_mm", "rms_height_mm", "rms_shifted_mm",
                        "rms_height_shifted_mm", "misfit_mm")),
                     percent(q.get("coverage_plan")), percent(q.get("coverage_height")),
                     text(q.get("interval_score_plan_mm")), text(q.get("interval_score_height_mm")),
                     text(one["cpu_seconds"])])
    return table(head, rows)


def parameter_table(scores):
    """Errors of single parameters and their standard deviations, of methods that state them; one
    column where two state the same."""
    stated = []
    for one in scores:
        if any(row["stated"] for row in one.get("rows", [])) and not any(
                one["rows"] == other["rows"] for other in stated):
            stated.append(one)
    if not stated:
        return ""

    def cell(row):
        if not row["stated"]:
            return "-"
        std = "no std" if row["std"] is None else format(row["std"], ".2g")
        return f"{row['error']:.3g} ({std})"
    rows = [[row["name"], row["unit"], *(cell(one["rows"][i]) for one in stated)]
            for i, row in enumerate(stated[0]["rows"])]
    return table(["parameter", "unit", *(one["entry"] for one in stated)], rows)


def sentence(words):
    """A paragraph of lines that are short enough for a page."""
    return textwrap.fill(words, 98) + "\n"


def write(path, scores, failures, left_out, chosen):
    entries = []
    for one in scores:
        if one["entry"] not in entries:
            entries.append(one["entry"])
    parts = [HEAD, "## All blocks\n",
             "Root mean squares over blocks; means of interval scores, coverages and seconds.\n",
             summary(scores, failures, entries)]
    parts += [sentence(f"{name} was left out: {reason}.") for name, reason in left_out.items()]
    parts += [sentence(f"{name} has no result for {block}: {reason}.")
              for (name, block), reason in failures.items()]
    for block in chosen:
        own = [one for one in scores if one["block"] == block.name]
        parts += [f"\n## {block.name}\n", block.title[0].upper() + block.title[1:] + ".\n",
                  block_table(own)]
        parts += [sentence(f"{one['entry']}: {one['note']}.") for one in own if one.get("note")]
        errors = parameter_table(own)
        if errors:
            parts += ["Errors of parameters (and the standard deviations that were stated):\n",
                      errors]
    spent = sum(filter(None, (one["cpu_seconds"] for one in scores))) / 60.0
    parts.append(f"\nThe methods took {spent:.0f} minutes of CPU time.\n")
    part = path.with_name(path.name + ".part")
    part.write_text("\n".join(parts))
    part.replace(path)
