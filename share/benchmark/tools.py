# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""What the scripts of the benchmark share: programs and blocks by name."""
import pathlib
import shutil

import blocks


def find(program, folder=None):
    """The path of one of our tools: in a folder that is given, in the build folder beside this
    script, or on the search path."""
    place = folder or pathlib.Path(__file__).resolve().parents[2] / "build" / "bin"
    if (place / program).exists():
        return (place / program).resolve()
    found = None if folder else shutil.which(program)
    if not found:
        raise SystemExit(f"{program}: not found in {place}; build the project, or name the folder "
                         "with --tools")
    return pathlib.Path(found)


def chosen(names):
    """The blocks of a list separated by commas; all where it is empty."""
    if not names:
        return list(blocks.BLOCKS)
    known = {block.name: block for block in blocks.BLOCKS}
    for name in names.split(","):
        if name not in known:
            raise SystemExit(f"block '{name}' is not known; there are {', '.join(known)}")
    return [known[name] for name in names.split(",")]
