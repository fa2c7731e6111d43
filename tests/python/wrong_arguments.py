# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""Calls every function, constructor, method and setter of the package with wrong arguments.

  wrong_arguments.py FIRST: prints the number and text of each case from that number on before it is
  run, so that the last line names the one that ended the interpreter, and 'WRONG ...' for an answer
  that is neither a usual exception nor a line. Cases follow from the signatures of the package.
"""
import copy
import inspect
import itertools
import pickle
import sys

import numpy as np

import pcl_als
from pcl_als import _arguments

ANSWERS = (TypeError, ValueError, OSError, IndexError, pcl_als.Error)
CLASSES = {name: value for name, value in vars(pcl_als).items()
           if inspect.isclass(value) and not issubclass(value, Exception)}
FUNCTIONS = {name: vars(pcl_als)[name] for name in pcl_als.__all__
             if callable(vars(pcl_als)[name]) and name not in CLASSES and not inspect.isclass(vars(pcl_als)[name])}


def generator():
    yield None


WRONG = {
    "None": lambda: None, "[]": list, "[None]": lambda: [None], "()": tuple, "{}": dict, "{1}": lambda: {1},
    "generator": generator, "empty generator": lambda: iter(()), "object": object, "-1": lambda: -1, "1e30": lambda: 1e30,
    "10**30": lambda: 10**30, "nan": lambda: float("nan"), "''": str, "'a': 1": lambda: {"a": 1}, "b'x'": lambda: b"x",
    "NUL": lambda: "a\0b", "array": lambda: np.zeros((2, 3)), "objects": lambda: np.array([None, object()]),
    "empty array": lambda: np.zeros(0), "class": lambda: int, "function": lambda: len, "type": lambda: pcl_als.Strip,
    **{f"{name}.__new__": lambda cls=cls: cls.__new__(cls) for name, cls in CLASSES.items()},
    **{f"[{name}.__new__]": lambda cls=cls: [cls.__new__(cls)] for name, cls in CLASSES.items()},
}


class Valid:
    """Values that fit, by the names of parameters; objects of all classes that can be made quickly."""

    def __init__(self):
        points = pcl_als.empty_points(200)
        points["x"], points["y"] = np.arange(200) % 20, np.arange(200) // 20
        points["gps_time"] = 100.0 + np.arange(200) * 0.01
        strip = pcl_als.Strip(points, id="1")
        pcl_als.write_points("tiny.las", strip)
        flight = pcl_als.Flight([[99 + 0.1 * i, 2.0 * i, 5.0, 500.0] for i in range(60)])
        with open("flight.csv", "w") as file:
            file.write("time,x,y,z\n" + "".join(f"{99 + 0.1 * i},{2 * i},5,500\n" for i in range(60)))
        lines = [pcl_als.FlightLine(id=str(i), start=[0, 0], end=[900, 90 * i], height=800) for i in range(2)]
        plan = pcl_als.plan(lines)
        simulation = pcl_als.Simulation(scale=0.05, density=0.1)
        self.values = {
            "points": ["tiny.las"], "files": ["tiny.las"], "inputs": ["tiny.las"], "outputs": ["out.las"],
            "input": "tiny.las", "output": "out.las", "path": "out.pcd", "paths": ["flight.csv"], "folder": "folder",
            "trajectory": flight, "calibration": plan.expected, "strip": strip, "strips": strip, "source": strip,
            "target": strip, "lines": lines, "simulation": simulation, "samples": flight.samples, "name": "boresight_roll",
            "ground": [0, 0, 0], "errors": "", "gains": "", "only": ["1"],
        }
        statistics = pcl_als.ClassStatistics.__new__(pcl_als.ClassStatistics)
        statistics.__setstate__(("a", np.zeros(1), np.eye(1), 1.0, 5, 0.0))
        model = pcl_als.ClassModel.__new__(pcl_als.ClassModel)
        model.__setstate__((["height"], [statistics]))
        made = (strip, flight, simulation, plan, plan.expected, model, statistics, pcl_als.icpatch(strip, strip),
                pcl_als.Survey(["tiny.las"]), pcl_als.ControlPoint("1", 0, 0, 0), *plan.expected.parameters.values())
        self.objects = {type(each).__name__: each for each in made}

    def of(self, parameter):
        """A value for a parameter, by its name or else by its type."""
        if parameter.name in self.values:
            return self.values[parameter.name]
        outer, _ = _arguments._outer(parameter.type)
        return {"str": "x", "int": 1, "float": 1.0, "os.PathLike": "missing.csv"}.get(outer, "x")

    def object_of(self, cls):
        """An object of a class; None where only jobs make one."""
        if cls.__name__ in self.objects:
            return self.objects[cls.__name__]
        try:
            return cls()
        except TypeError:
            return None


def wrong_calls(label, function, parameters, valid):
    """Calls with one wrong argument, and with all of them wrong."""
    needed = [each for each in parameters if each.needed]
    for wrong, make in WRONG.items():
        for each in parameters:
            def one(each=each, make=make):
                return function(**{other.name: valid.of(other) for other in needed if other is not each}, **{each.name: make()})
            yield f"{label}({each.name}={wrong})", one
        yield f"{label}(all {wrong})", lambda make=make: function(*(make() for _ in needed))
    yield f"{label}(too many)", lambda: function(*range(20))
    yield f"{label}(unknown)", lambda: function(unknown_keyword=None)


def function_cases(valid):
    for name, function in FUNCTIONS.items():
        for parameters, _ in _arguments.signatures(function):
            yield from wrong_calls(name, function, parameters, valid)


def class_cases(valid):
    for name, cls in CLASSES.items():
        if _arguments._has_constructor(cls):
            for parameters, free in _arguments.signatures(cls.__init__):
                settings = _arguments.settings_of(cls) if free else []
                yield from wrong_calls(name, cls, parameters[1:], valid)
                for setting, (wrong, make) in itertools.product(settings, WRONG.items()):
                    yield f"{name}({setting}={wrong})", lambda s=setting, c=cls, m=make: c(**{s: m()})
        else:
            yield f"{name}()", cls
        made = valid.object_of(cls)
        if made is not None:
            yield from object_cases(name, cls, made, valid)
        yield from unmade_cases(name, cls, valid)


def methods_of(cls):
    for name, value in vars(cls).items():
        if callable(value) and not name.startswith("_"):
            described = "->" in (value.__doc__ or "")
            yield name, (_arguments.signatures(value)[0][0][1:] if described else [])


def object_cases(name, cls, made, valid):
    for method, parameters in methods_of(cls):
        yield from wrong_calls(f"{name}.{method}", getattr(made, method), parameters, valid)
        for wrong, make in WRONG.items():
            yield f"{name}.{method}(self={wrong})", lambda m=method, make=make: vars(cls)[m](make())
    for setting, (wrong, make) in itertools.product(_arguments.settings_of(cls), WRONG.items()):
        yield f"{name}.{setting} = {wrong}", lambda s=setting, m=make: setattr(copy.copy(made) if name != "Simulation"
                                                                                else made, s, m())


def refused(action):
    """What an object without __init__ has to answer with."""
    try:
        action()
    except TypeError as error:
        if "without its __init__" in str(error):
            return
        raise AssertionError(f"another message: {error}") from error
    raise AssertionError("not refused")


def unmade_cases(name, cls, valid):
    """Everything that can be done with an object that was made without __init__."""
    def unmade():
        return cls.__new__(cls)
    for attribute, value in vars(cls).items():
        if isinstance(value, property):
            yield f"unmade {name}.{attribute}", lambda a=attribute: refused(lambda: getattr(unmade(), a))
    for method, parameters in methods_of(cls):
        arguments = [valid.of(each) for each in parameters if each.needed]
        yield f"unmade {name}.{method}()", lambda m=method, a=arguments: refused(lambda: getattr(unmade(), m)(*a))
    for action in (pickle.dumps, copy.copy, copy.deepcopy, repr, str):
        yield f"{action.__name__}(unmade {name})", lambda a=action: a(unmade())
    if hasattr(cls, "__len__"):
        yield f"len(unmade {name})", lambda: refused(lambda: len(unmade()))


def answer_of(action):
    """What is wrong with the answer; empty: nothing."""
    try:
        action()
    except ANSWERS as error:
        text = str(error)
        return "" if text and "\n" not in text and "pybind11" not in text else f"{type(error).__name__}: {text!r}"
    except Exception as error:
        return f"{type(error).__name__}: {error!r}"
    return ""


def main():
    first = int(sys.argv[1])
    valid = Valid()
    for i, (text, action) in enumerate(itertools.chain(function_cases(valid), class_cases(valid))):
        if i < first:
            continue
        print(i, text, flush=True)
        wrong = answer_of(action)
        if wrong:
            print("WRONG", text, "->", wrong, flush=True)
    print("END", flush=True)


if __name__ == "__main__":
    main()
