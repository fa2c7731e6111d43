# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""How objects show themselves, their tables, and copies of settings."""
import functools
import html
import inspect
from typing import Any

import numpy

from . import _pcl_als
from ._arguments import _shown, settings_of

_LONGEST = 100  # characters of what the text of an object lists
_SCALARS = (str, bool, int, float, type(None))


def _properties(cls):
    return [name for name, value in vars(cls).items() if isinstance(value, property)]


def _is_bound(value):
    """Whether a value is an object of a class of the package."""
    return getattr(_pcl_als, type(value).__name__, None) is type(value)


# Tables.


def frame_of(columns):
    """A pandas.DataFrame of columns by name, or the dictionary itself where pandas is missing."""
    try:
        import pandas
    except ImportError:
        return columns
    return pandas.DataFrame(columns)


def _row(value, prefix=""):
    """The attributes of an object that are numbers or texts, with those of the objects inside it."""
    row = {}
    for name in _properties(type(value)):
        content = getattr(value, name)
        if isinstance(content, _SCALARS):
            row[prefix + name] = content
        elif _is_bound(content) and not prefix:
            row.update(_row(content, name + "_"))
    return row


def _columns_of(objects):
    rows = [_row(each) for each in objects]
    return {name: [row.get(name) for row in rows] for name in (rows[0] if rows else ())}


def _calibration_columns(result, table="parameters"):
    tables = {"parameters": list(result.parameters.values()), "pairs": result.pairs, "control": result.control,
              "diagnosis": result.diagnosis}
    if table not in tables:
        raise ValueError(f"table: '{table}' is none of '" + "', '".join(tables) + "'")
    return _columns_of(tables[table])


def _alignment_columns(result):
    return {"parameter": ["XT", "YT", "ZT", "omega", "phi", "kappa"], "unit": ["m"] * 3 + ["rad"] * 3,
            "value": result.values, "std": result.std}


def _strip_columns(strip):
    ground, points = strip.ground(), strip.points
    columns = {name: ground[:, i] for i, name in enumerate("xyz")}
    columns.update({name: points[name].copy() for name in points.dtype.names if name not in columns})
    columns.update(strip.extra)
    return columns


def _flight_columns(flight):
    return dict(zip(("time", "x", "y", "z", "roll", "pitch", "heading"), flight.samples.T))


def _intensity_columns(result):
    return {"strip": list(result.gains), "gain": list(result.gains.values())}


def _survey_columns(survey):
    return {"strip": list(survey.points_by_strip), "points": list(survey.points_by_strip.values())}


def _waveform_columns(result):
    """The echoes of the waveforms in the result."""
    columns = {"number": [], "time_ns": [], "time_std_ns": [], "amplitude": [], "amplitude_std": [], "width_ns": [],
               "width_std_ns": [], "new_echo": []}
    for waveform in result.to_dict()["waveforms"]:
        for echo in waveform["echoes"]:
            columns["number"].append(waveform["number"])
            for name, value in echo.items():
                columns[name].append(value)
    return columns


def _cover_columns(cover):
    return {"class": cover.model.classes, "cells": cover.cells} if cover.model else {"class": [], "cells": []}


_COLUMNS = {
    "Alignment": (_alignment_columns, "The six parameters"),
    "CheckResult": (lambda result: _columns_of(result.block.pairs), "The pairs of strips"),
    "CheckedBlock": (lambda block: _columns_of(block.pairs), "The pairs of strips"),
    "Flight": (_flight_columns, "The samples"),
    "IntensityResult": (_intensity_columns, "The gains of the strips"),
    "LandCover": (_cover_columns, "The cells of each class"),
    "PlanResult": (lambda plan: _calibration_columns(plan.expected), "The expected parameters"),
    "Strip": (_strip_columns, "The points, in the ground frame,"),
    "Survey": (_survey_columns, "The strips"),
    "WaveformResult": (_waveform_columns, "The echoes of the waveforms in to_dict()"),
}


def _frame_method(columns, what):
    def to_frame(self) -> Any:
        return frame_of(columns(self))

    to_frame.__doc__ = f"{what} as a pandas.DataFrame; as a dictionary of columns where pandas is missing."
    return to_frame


def _calibration_frame(self, table: str = "parameters") -> Any:
    """A table as a pandas.DataFrame; as a dictionary of columns where pandas is missing. table: 'parameters',
    'pairs', 'control' or 'diagnosis'."""
    return frame_of(_calibration_columns(self, table))


# Texts.


def _reliability(result):
    return "reliable" if result.reliable else f"not reliable: {result.reason}"


def _calibration_summary(result):
    estimated = [each for each in result.parameters.values() if each.status == "estimated"]
    misfit = f", misfit {result.misfit.rms_before:.3f} -> {result.misfit.rms_after:.3f} m" if result.misfit.points else ""
    return f"{result.verdict}; {len(estimated)} parameters, {len(result.pairs)} pairs{misfit}"


def _check_summary(result):
    judged = [pair for pair in result.block.pairs if pair.status == "judged"]
    largest = f", largest RMSDz {max(pair.vertical.rms for pair in judged):.3f} m" if judged else ""
    return f"{_reliability(result)}; {len(result.block.pairs)} pairs{largest}"


def _cover_summary(cover):
    undetermined = ", ".join(cover.undetermined)
    verdict = f"not reliable: too few samples of {undetermined}" if undetermined else "reliable"
    accuracy = "" if cover.overall_accuracy is None else f", accuracy {cover.overall_accuracy:.1%}"
    return f"{verdict}; {len(cover.cells)} classes{accuracy}"


def _plan_summary(plan):
    verdict = "determined" if plan.determined else "not determined: " + plan.expected.verdict.reason
    return f"{verdict}; {len(plan.lines)} lines"


_SUMMARIES = {
    "Alignment": lambda a: f"{_reliability(a)}; RMS {a.rms_before:.3f} -> {a.rms_after:.3f} m",
    "CalibrationResult": _calibration_summary,
    "CalibrationVerdict": str,
    "CheckResult": _check_summary,
    "Flight": lambda flight: f"{len(flight)} samples, {flight.start_time:.1f} to {flight.end_time:.1f} s"
                             + (", with attitude" if flight.has_attitude else ", positions only"),
    "IntensityResult": lambda result: f"{_reliability(result)}; {len(result.gains)} strips",
    "LandCover": _cover_summary,
    "LeftOutPoints": str,
    "Orientation": lambda result: f"{_reliability(result)}; sigma0 {result.sigma0:.3g}",
    "PlanResult": _plan_summary,
    "WaveformResult": lambda result: f"{result.echoes} echoes in {result.waveforms} waveforms, {result.new_echoes} new",
    "Survey": lambda survey: f"{len(survey)} points in {len(survey.strips)} strips",
}


def _listed(values):
    """'name=value, ...' of values that are numbers or texts, shortened."""
    parts, length = [], 0
    for name, value in values.items():
        text = f"{value:.6g}" if isinstance(value, float) else repr(value)
        parts.append(f"{name}={text if len(text) <= 40 else text[:37] + '...'}")
        length += len(parts[-1])
        if length > _LONGEST:
            return ", ".join(parts[:-1] + ["..."])
    return ", ".join(parts)


def _plain(self):
    return f"<pcl_als.{type(self).__name__} {_listed(_row(self, ' '))}>".replace(" =", "=").replace("  ", " ")


def _summarised(self):
    return f"<pcl_als.{type(self).__name__}: {_SUMMARIES[type(self).__name__](self)}>"


def _cell(value):
    return html.escape(f"{value:.4g}" if isinstance(value, float) else str(value))


def _html(self):
    """The summary, and the table of to_frame(), in short."""
    name = type(self).__name__
    heading = f"<p><b>{name}</b>: {html.escape(_SUMMARIES[name](self))}</p>"
    if not hasattr(self, "to_frame") or name in ("Flight", "Survey"):
        return heading
    columns = _calibration_columns(self) if name == "CalibrationResult" else _COLUMNS[name][0](self)
    shown = list(columns)[:8]
    head = "".join(f"<th>{html.escape(each)}</th>" for each in shown)
    count = len(next(iter(columns.values()), ()))
    rows = ["".join(f"<td>{_cell(columns[each][i])}</td>" for each in shown) for i in range(min(count, 20))]
    more = f"<p>{count - 20} more rows</p>" if count > 20 else ""
    body = "".join(f"<tr>{row}</tr>" for row in rows)
    return f"{heading}<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>{more}"


# Settings.


def _same(one, other):
    if isinstance(one, numpy.ndarray):
        return numpy.array_equal(one, other)
    return repr(one) == repr(other) if _is_bound(one) else one == other


def _changed(self):
    """The settings that differ from the defaults: Settings(threads=2)."""
    default = type(self)()
    values = {name: getattr(self, name) for name in settings_of(_base_of(type(self)))}
    changed = [f"{name}={value!r}" for name, value in values.items() if not _same(value, getattr(default, name))]
    return f"{type(self).__name__}({', '.join(changed)})"


def _base_of(cls):
    return next(each for each in cls.__mro__ if getattr(_pcl_als, each.__name__, None) is each)


def make_settings(cls, values):
    """Settings from their attributes; for pickle."""
    return cls(**values)


def _reduced(self):
    return make_settings, (type(self), {name: getattr(self, name) for name in settings_of(_base_of(type(self)))})


def _method_of(cls, function):
    """The function as to_frame() of the class, which refuses objects of other classes as the compiled methods do."""
    @functools.wraps(function)
    def to_frame(self, *args, **kwargs):
        if not isinstance(self, cls):
            raise TypeError(f"{cls.__name__}.to_frame(): self must be {cls.__name__}, not {_shown(self)}")
        return function(self, *args, **kwargs)

    to_frame.__name__, to_frame.__qualname__ = "to_frame", f"{cls.__name__}.to_frame"
    return to_frame


def add_methods(cls):
    """Texts, tables and copies of a class."""
    name = cls.__name__
    text = vars(cls)["__init__"].__doc__ if "__init__" in vars(cls) else None
    if text and "**kwargs) -> None" in text:
        cls.__reduce__ = _reduced
        cls.__repr__ = _changed
    elif name in _SUMMARIES:
        cls.__repr__ = _summarised
        cls._repr_html_ = _html
    elif "__repr__" not in vars(cls):
        cls.__repr__ = _plain
    if name == "CalibrationResult":
        cls.to_frame = _method_of(cls, _calibration_frame)
    elif name in _COLUMNS:
        cls.to_frame = _method_of(cls, _frame_method(*_COLUMNS[name]))


def add_to_module():
    """Adds the methods to all classes of the package."""
    for value in list(vars(_pcl_als).values()):
        if inspect.isclass(value) and not issubclass(value, Exception):
            add_methods(value)
