#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""python_stubs.py: prints the type stubs of the package that can be imported (PYTHONPATH).

Names, signatures and docstrings are those of the module, so that the stubs are never edited:
  PYTHONPATH=build/python share/dev/python_stubs.py > modules/python/pcl_als/__init__.pyi
"""
import inspect
import re
import textwrap

import pcl_als
from pcl_als._arguments import uniform_types

HEADER = '''# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
# Made by share/dev/python_stubs.py; not to be edited.
import os
import pathlib
from typing import Any, Callable, Iterable, Mapping, Optional, Union

import numpy
from numpy.typing import ArrayLike

_Path = Union[str, os.PathLike]
'''
INDENT = "    "


def types_of(text):
    """Types of pybind11 as those of Python's annotations."""
    text = re.sub(r"\bpcl_als\.", "", text)
    text = re.sub(r"numpy\.ndarray\[numpy\.\w+(\[[^]]*\])?\]", "numpy.ndarray", text)
    text = re.sub(r"list\[(\w+), \d+\]", r"list[\1]", uniform_types(text))
    text = text.replace("os.PathLike", "_Path").replace("handle", "Any")
    return re.sub(r"\bobject\b", "Any", text)


def signature_of(docstring):
    """The signature line of a function and the text below it."""
    head, _, text = docstring.partition("\n")
    match = re.fullmatch(r"\w+(\(.*\)) -> (.*)", head)
    if match is None:
        raise ValueError(f"no signature: {docstring!r}")
    arguments, result = match.groups()
    arguments = re.sub(r"= array\([^)]*\)", "= ...", arguments)
    arguments = re.sub(r"= \w+\(\)", "= ...", arguments)
    # What is returned is a path itself, not a text.
    returned = types_of(result).replace("_Path", "pathlib.Path")
    # What is taken is more than what is returned.
    taken = types_of(arguments).replace("numpy.ndarray", "ArrayLike").replace("list[", "Iterable[")
    taken = taken.replace("strips: StripChoice", "strips: Union[StripChoice, Iterable[str]]")
    return taken, returned, text.strip()


def documented(text, depth):
    if not text:
        return " ..."
    wrapped = textwrap.fill('"""' + text.replace("\\", "\\\\") + '"""', 96 - 4 * depth)
    return "\n" + textwrap.indent(wrapped, INDENT * depth)


def python_stub(name, function, depth):
    """The stub of a function that is written in Python."""
    signature = str(inspect.signature(function)).replace("typing.", "")
    return f"{INDENT * depth}def {name}{signature}:" + documented(" ".join(function.__doc__.split()), depth + 1)


def function_stub(name, docstring, depth=0):
    docstring = docstring.strip()
    if docstring.startswith(f"{name}(*args, **kwargs)\nOverloaded function."):
        parts = re.split(r"\n\d+\. ", docstring)[1:]
    else:
        parts = [docstring]
    lines = []
    for part in parts:
        arguments, result, text = signature_of(part)
        if len(parts) > 1:
            lines.append(INDENT * depth + "@overload")
        # The type of self is that of the class.
        if depth:
            arguments = re.sub(r"^\(\w+: [\w.]+", "(self", arguments)
        lines.append(f"{INDENT * depth}def {name}{arguments} -> {result}:" + documented(text, depth + 1))
    return "\n".join(lines)


def property_stub(name, value):
    docstring = (value.fget.__doc__ or "").strip()
    result = signature_of("f" + docstring.partition("\n")[0])[1] if docstring else "Any"
    text = (value.__doc__ or "").strip()
    text = re.sub(r"^\w*\(.*?\) -> .*?(\n|$)", "", text).strip()
    lines = [f"{INDENT}@property", f"{INDENT}def {name}(self) -> {result}:" + documented(text, 2)]
    if value.fset is not None:
        arguments = signature_of("f" + value.fset.__doc__.strip().partition("\n")[0])[0]
        given = re.fullmatch(r"\(\w+: \w+, arg\d: (.*)\)", arguments).group(1)
        lines += [f"{INDENT}@{name}.setter", f"{INDENT}def {name}(self, value: {given}) -> None: ..."]
    return "\n".join(lines)


def class_stub(name, value):
    bases = [base.__name__ for base in value.__bases__ if base.__name__ not in ("object", "pybind11_object")]
    lines = [f"class {name}" + (f"({', '.join(bases)})" if bases else "") + ":"]
    text = inspect.cleandoc(value.__doc__ or "")
    lines.append(textwrap.indent(textwrap.fill(f'"""{text}"""', 92), INDENT))
    if issubclass(value, Exception):
        return "\n".join(lines + ([f"{INDENT}remedy: Optional[str]"] if name == "Error" else []))
    for member in sorted(vars(value)):
        content = vars(value)[member]
        if isinstance(content, property):
            lines.append(property_stub(member, content))
        elif member in ("__init__", "__len__") or not member.startswith("_"):
            docstring = content.__doc__ or ""
            if inspect.isfunction(content) and ") -> " not in docstring:
                lines.append(python_stub(member, content, 1))
            elif not docstring.startswith("Initialize self"):  # a class that only jobs make
                lines.append(function_stub(member, docstring, 1))
    return "\n".join(lines)


def stubs():
    parts = []
    for name in pcl_als.__all__:
        value = getattr(pcl_als, name)
        if inspect.isclass(value):
            parts.append(class_stub(name, value))
        elif callable(value):
            parts.append(function_stub(name, value.__doc__))
        else:
            parts.append(f"{name}: {type(value).__module__.split('.')[0]}.dtype")
    text = "\n\n".join(["__version__: str", "__all__: list[str]"] + parts) + "\n"
    header = HEADER.replace("Union\n", "Union, overload\n") if "@overload" in text else HEADER
    return header + "\n" + text


if __name__ == "__main__":
    print(stubs(), end="")
