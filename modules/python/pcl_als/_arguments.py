# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""What is between a caller and the functions of the extension module.

Any iterable may be given where a list is taken. An argument that does not fit is answered with one
line that names it, and an error that an argument may be set about with the name of that argument.
Types are those of the signatures, which pybind11 writes into the docstrings.
"""
import ast
import functools
import inspect
import os
import re

import numpy

from . import _pcl_als

_LISTS = ("list", "Sequence")


class _Parameter:
    """A parameter of a function: its name, type (an expression) and whether it is needed."""

    def __init__(self, argument, default, keyword_only):
        self.name = argument.arg
        self.type = argument.annotation
        self.needed = default is None
        self.keyword_only = keyword_only


def _takes_lists(node):
    """Whether a type is one of a list, or has one among alternatives; ids are a StripChoice as well."""
    names = {getattr(each, "id", getattr(each, "attr", None)) for each in ast.walk(node)}
    return "StripChoice" in names or not names.isdisjoint(_LISTS)


def uniform_types(text):
    """A signature with types in one spelling. That of pybind11 depends on its version: List[str] or list[str]; of
    a list of a fixed size List[float[4]] or Annotated[list[float], FixedSize(4)], here list[float, 4]."""
    text = re.sub(r"\b(List|Dict|Tuple|Set)\[", lambda found: found.group().lower(), text)
    text = re.sub(r"Annotated\[list\[(\w+)\], FixedSize\((\d+)\)\]", r"list[\1, \2]", text)
    return re.sub(r"list\[(\w+)\[(\d+)\]\]", r"list[\1, \2]", text)


def _signature(text):
    """The parameters in a line '(self: Strip, count: int = 0) -> None', and whether keywords are free."""
    arguments = ast.parse(f"def f{uniform_types(text)}: pass").body[0].args
    plain = arguments.args
    defaults = [None] * (len(plain) - len(arguments.defaults)) + arguments.defaults
    found = [_Parameter(each, default, False) for each, default in zip(plain, defaults)]
    found += [_Parameter(each, default, True) for each, default in zip(arguments.kwonlyargs, arguments.kw_defaults)]
    return found, arguments.kwarg is not None


def signatures(function):
    """The parameters of each overload of a function of the extension module."""
    lines = [line.strip() for line in function.__doc__.strip().splitlines()]
    heads = [line[line.index("("):] for line in lines if ") -> " in line and "(*args, **kwargs)" not in line]
    overloads = [line for line in lines if line[:1].isdigit() and ") -> " in line]
    return [_signature(head) for head in (heads if overloads else heads[:1])]


def settings_of(cls):
    """The names of the attributes of a class that can be set."""
    return [name for name, value in vars(cls).items() if isinstance(value, property) and value.fset is not None]


# Types of values.


def _number(value, kinds):
    return isinstance(value, kinds) or (isinstance(value, numpy.ndarray) and value.ndim == 0)


def _is_list(value):
    return hasattr(value, "__len__") and hasattr(value, "__getitem__") and not isinstance(value, (str, bytes, dict))


def _fits_array(value, parts):
    try:
        array = numpy.asarray(value, dtype=float)
    except (TypeError, ValueError):
        return getattr(getattr(value, "dtype", None), "names", None) is not None
    text = ast.unparse(parts[0]) if parts else ""
    sizes = [int(size) for size in text.partition("[")[2].rstrip("]").split(",") if size.strip().isdigit()]
    return not sizes or array.size == numpy.prod(sizes)


def _fits_class(value, name):
    cls = getattr(_pcl_als, name, None)
    if cls is None or isinstance(value, cls):
        return True
    return name == "StripChoice" and _is_list(value) and all(isinstance(each, str) for each in value)


_PLAIN = {
    "str": lambda value: isinstance(value, (str, bytes)),
    "bool": lambda value: value is None or hasattr(value, "__bool__"),
    "int": lambda value: _number(value, (int, numpy.integer, numpy.bool_)),
    "float": lambda value: _number(value, (int, float, numpy.number, numpy.bool_)),
    "None": lambda value: value is None,
    "tuple": lambda value: isinstance(value, tuple),
    "dict": lambda value: isinstance(value, dict),
    "numpy.ndarray": lambda value: isinstance(value, numpy.ndarray),
    "os.PathLike": lambda value: isinstance(value, (str, bytes, os.PathLike)),
    "object": lambda value: True,
    "handle": lambda value: True,
}


def _fits_parts(value, outer, parts):
    """Whether a value fits a type with others inside, such as list[str]."""
    if outer == "Union":
        return any(_fits(value, part) for part in parts)
    if outer == "Optional":
        return value is None or _fits(value, parts[0])
    if outer in _LISTS:
        count = ast.unparse(parts[1]) if len(parts) > 1 else None
        return (_is_list(value) and (count is None or len(value) == int(count))
                and all(_fits(each, parts[0]) for each in value))
    if outer == "tuple":
        return _is_list(value) and len(value) == len(parts) and all(map(_fits, value, parts))
    if outer == "dict":
        return (isinstance(value, dict) and all(_fits(each, parts[0]) for each in value)
                and all(_fits(each, parts[1]) for each in value.values()))
    if outer == "Mapping":
        return hasattr(value, "items")
    if outer == "Callable":
        return callable(value)
    return outer != "numpy.ndarray" or _fits_array(value, parts)


def _outer(node):
    """The name of a type, and the types inside it."""
    if isinstance(node, ast.BinOp):  # int | str
        return "Union", [node.left, node.right]
    if not isinstance(node, ast.Subscript):
        return ast.unparse(node), []
    inside = node.slice
    return ast.unparse(node.value).replace("typing.", "").replace("collections.abc.", ""), inside.elts if isinstance(inside, ast.Tuple) else [inside]


def _fits(value, node):
    outer, parts = _outer(node)
    if parts:
        return _fits_parts(value, outer, parts)
    if outer.startswith("pcl_als."):
        return _fits_class(value, outer.rpartition(".")[2])
    return _PLAIN[outer](value) if outer in _PLAIN else True


def _alternatives(node):
    """The types that a type is one of."""
    outer, parts = _outer(node)
    if outer == "Optional":
        return _alternatives(parts[0]) + [ast.Constant(None)]
    return [each for part in parts for each in _alternatives(part)] if outer == "Union" else [node]


def _named(node):
    """A type in words: 'Flight, path or list of paths'."""
    outer, parts = _outer(node)
    if outer in ("Union", "Optional"):
        names = list(dict.fromkeys(_named(each) for each in _alternatives(node)))
        names = [name for name in names if name != "None"] + ["None"] * ("None" in names)
        return ", ".join(names[:-1]) + " or " + names[-1] if len(names) > 1 else names[0]
    if outer in _LISTS:
        count = ast.unparse(parts[1]) + " " if len(parts) > 1 else ""
        return f"list of {count}" + _named(parts[0]) + "s" * (_named(parts[0]) == "path")
    if outer == "tuple" and parts:
        return "tuple of " + " and ".join(_named(part) for part in parts)
    if outer == "numpy.ndarray":
        text = ast.unparse(parts[0]) if parts else ""
        return "array" + (" of shape " + text.partition("[")[2].rstrip("]") if "[" in text else "")
    plain = {"os.PathLike": "path", "Callable": "callable", "Mapping": "mapping"}
    return plain.get(outer, outer.rpartition(".")[2])


def _shown(value):
    """A value in a few words."""
    if value is None or isinstance(value, (bool, int, float)):
        return str(value)
    if isinstance(value, type):
        return f"the class {value.__name__}"
    if isinstance(value, (str, bytes)):
        return repr(value) if len(value) <= 40 else repr(value[:37])[:-1] + "...'"
    if isinstance(value, (list, tuple)) and not value:
        return "an empty " + type(value).__name__
    if isinstance(value, (list, tuple)):
        kinds = sorted({"None" if each is None else type(each).__name__ for each in value})
        return f"{type(value).__name__} of " + ", ".join(kinds[:3])
    return type(value).__name__


# Messages.


def _nearest(word, names):
    """'; did you mean ...?' or the names that there are."""
    nearest = _pcl_als._nearest_name(word, list(names))
    if nearest:
        return f"; did you mean '{nearest}'?"
    return "; options are " + ", ".join(names) if names else "; there are none"


def _misnamed(label, parameters, args, kwargs):
    """What is wrong with names and numbers of arguments; empty: nothing."""
    names = [each.name for each in parameters]
    places = [each for each in parameters if not each.keyword_only]
    for name in kwargs:
        if name not in names:
            others = [each.name for each in parameters if each.name not in kwargs and each not in places[:len(args)]]
            return f"{label}(): unknown option '{name}'" + _nearest(name, others)
    if len(args) > len(places):
        most = ", ".join(each.name for each in places) or "none"
        return f"{label}(): {len(args)} positional arguments are given; it takes {most}, others by name"
    for each in places[:len(args)]:
        if each.name in kwargs:
            return f"{label}(): {each.name} is given twice"
    for i, each in enumerate(parameters):
        if each.needed and each.name not in kwargs and (each.keyword_only or i >= len(args)):
            return f"{label}(): {each.name} is missing"
    return ""


def _misfit(label, parameters, args, kwargs):
    """What is wrong with the values of arguments; empty: it was not found."""
    places = [each for each in parameters if not each.keyword_only]
    given = list(zip(places, args)) + [(each, kwargs[each.name]) for each in parameters if each.name in kwargs]
    for each, value in given:
        if not _fits(value, each.type):
            return f"{label}(): {each.name} must be {_named(each.type)}, not {_shown(value)}"
    for each, value in given:
        if _number(value, (int, numpy.integer)) and not 0 <= int(value) < 2**31:
            return f"{label}(): {each.name} is out of range: {_shown(value)}"
    return ""


def _explained(label, found, bound, args, kwargs):
    """The message for arguments that no overload takes."""
    messages = []
    for parameters, free in found:
        parameters = parameters[1:] if bound else parameters
        if free and not args:
            continue
        messages.append(_misnamed(label, parameters, args, kwargs) or _misfit(label, parameters, args, kwargs))
    for message in messages:
        if message:
            return message
    shown = [_shown(value) for value in args] + [f"{name}={_shown(value)}" for name, value in kwargs.items()]
    return f"{label}(): does not take ({', '.join(shown)})"


def _as_list(value):
    """A list of any iterable that is neither one already nor a text, path or mapping."""
    if isinstance(value, (list, tuple, str, bytes, os.PathLike, dict)) or hasattr(value, "read"):
        return value
    return list(value) if hasattr(value, "__iter__") else value


def _listed(parameters, args, kwargs):
    places = [each for each in parameters if not each.keyword_only]
    lists = {each.name for each in parameters if _takes_lists(each.type)}
    args = [_as_list(value) if i < len(places) and places[i].name in lists else value for i, value in enumerate(args)]
    return args, {name: _as_list(value) if name in lists else value for name, value in kwargs.items()}


# What a caller may set about an error or a warning: keyword, value, effect.
_REMEDIES = {
    "force": ("force", "True", "continues"),
    "force_level": ("force", "True", "takes the sensor as level"),
    "keep_uncovered": ("keep_uncovered", "True", "leaves them as they are"),
    "nominal_model": ("attitude", "'nominal'", "takes the sensor as level with its heading along the course"),
    "positions_only": ("attitude", "'ignore'", "needs no attitude"),
    "recover_attitude": ("recover_attitude", "True", "recovers them from the points"),
    "crs": ("crs", "...", "states it"),
    "axes": ("axes", "'ned' or 'enu'", "states them"),
    "columns": ("columns", "...", "names the columns"),
    "leap_seconds": ("leap_seconds", "...", "states them"),
    "geoid": ("geoid", "...", "subtracts the undulation"),
    "max_distance": ("maximum_distance", "...", "compares surfaces that are further apart"),
    "control": ("control", "...", "gives it"),
    "control_sigma": ("control_sigma", "...", "states it"),
    "flight_sigmas": ("shared_errors", "SharedErrorModel(...)", "states them"),
    "strips": ("strips", "...", "chooses strips"),
    "channels": ("strips", "StripChoice(by_channel=True)", "divides them"),
}


def _remedy(function, name):
    """The keyword for a remedy, and what it does, as far as a function has it."""
    keyword, value, effect = _REMEDIES[name]
    parameters = {each.name: each for each in signatures(function)[0][0]}
    if keyword in parameters:
        return keyword, f"{keyword}={value} {effect}"
    if "settings" in parameters:
        cls = _outer(parameters["settings"].type)[0].rpartition(".")[2]
        if keyword in settings_of(getattr(_pcl_als, cls)):
            return "settings", f"settings={cls}({keyword}={value}) {effect}"
    reader = {each.name for each in signatures(_pcl_als.read_trajectory)[0][0]}
    if "trajectory" in parameters and keyword in reader:
        return "trajectory", f"trajectory=read_trajectory(..., {keyword}={value}) {effect}"
    return None, ""


def hinted(function, text, remedy):
    """A warning of a function with the argument that may be set about it."""
    hint = _remedy(getattr(_pcl_als, function), remedy)[1] if remedy else ""
    return f"{text}; {hint}" if hint else text


def _with_hint(function, error):
    """An error with the argument that may be set about it."""
    if error.remedy in _REMEDIES:
        error.remedy, hint = _remedy(function, error.remedy)
        if hint:
            error.args = (f"{error}; {hint}",)
    return error


# Functions and classes.


def checked(function, label, bound=False):
    """A function of the extension module, or with bound a method, with messages of one line."""
    found = signatures(function)
    longest = max((parameters for parameters, _ in found), key=len)

    @functools.wraps(function)
    def call(*args, **kwargs):
        listed, options = _listed(longest, args, kwargs)
        try:
            return function(*listed, **options)
        except TypeError as error:
            if "incompatible" not in str(error):
                raise
            message = _explained(label, found, bound, listed[1:] if bound else listed, options)
        except _pcl_als.Error as error:
            raise _with_hint(function, error)
        raise TypeError(message)

    del call.__wrapped__
    call.__module__, call.__qualname__ = "pcl_als", label
    return call


def _setter(function, label):
    """A setter of a property."""
    node = signatures(function)[0][0][1].type

    @functools.wraps(function)
    def set_value(self, value):
        try:
            function(self, _as_list(value) if _takes_lists(node) else value)
        except TypeError as error:
            if "incompatible" not in str(error):
                raise
            if _fits(value, node):
                raise ValueError(f"{label} is out of range: {_shown(value)}") from None
            raise TypeError(f"{label} must be {_named(node)}, not {_shown(value)}") from None

    return set_value


def _constructor(function, cls):
    """A constructor; of keywords that are attributes the names are checked."""
    inner = checked(function, cls.__name__, bound=True)
    if not any(free for _, free in signatures(function)):
        return inner
    names = settings_of(cls)

    @functools.wraps(inner)
    def construct(self, *args, **kwargs):
        for name in kwargs:
            if name not in names:
                raise TypeError(f"{cls.__name__}(): unknown option '{name}'" + _nearest(name, names))
        inner(self, *args, **kwargs)

    del construct.__wrapped__
    return construct


def _has_constructor(cls):
    return "__init__" in vars(cls) and "->" in (vars(cls)["__init__"].__doc__ or "")


def check_class(cls):
    """Puts checks around the constructor, the methods and the setters of a class."""
    for name, value in list(vars(cls).items()):
        if isinstance(value, property):
            if value.fset is not None:
                label = f"{cls.__name__}.{name}"
                setattr(cls, name, property(value.fget, _setter(value.fset, label), None, value.__doc__))
        elif callable(value) and not name.startswith("_"):
            setattr(cls, name, checked(value, f"{cls.__name__}.{name}", bound=True))
    if _has_constructor(cls):
        cls.__init__ = _constructor(vars(cls)["__init__"], cls)


def check_module():
    """The public names of the package: classes, and functions with checks around them."""
    names = {}
    for name, value in vars(_pcl_als).items():
        if name.startswith("_"):
            continue
        if inspect.isclass(value):
            if not issubclass(value, Exception):
                check_class(value)
        elif callable(value):
            value = checked(value, name)
        names[name] = value
    return names
